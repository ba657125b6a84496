#include "scene/race_track/canvas.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/color.h"

namespace sunlit::scene::race_track {
namespace {

constexpr int kEncoderSteps = 16384;

std::uint8_t encode(float linear) {
  static const std::vector<std::uint8_t> table = [] {
    std::vector<std::uint8_t> values(kEncoderSteps + 1);
    for (int i = 0; i <= kEncoderSteps; ++i) {
      // IEC 61966-2-1.
      const double v = static_cast<double>(i) / kEncoderSteps;
      const double e = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
      values[i] = static_cast<std::uint8_t>(std::lround(255.0 * e));
    }
    return values;
  }();
  return table[static_cast<int>(std::clamp(linear, 0.0f, 1.0f) * kEncoderSteps + 0.5f)];
}

// Distance of p from the segment a b.
float distanceTo(const Pixel& p, const Pixel& a, const Pixel& b) {
  const Pixel d = b - a;
  const float length2 = std::max(d.squaredNorm(), 1e-12f);
  const float t = std::clamp((p - a).dot(d) / length2, 0.0f, 1.0f);
  return (p - a - t * d).norm();
}

bool inside(const std::vector<Pixel>& corners, const Pixel& p) {
  bool in = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const Pixel& a = corners[i];
    const Pixel& b = corners[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
      in = !in;
  }
  return in;
}

}  // namespace

Canvas::Canvas(int width, int height, const Color& color, float alpha)
    : width_(width),
      height_(height),
      colors_(static_cast<std::size_t>(width) * height, color),
      alphas_(static_cast<std::size_t>(width) * height, alpha) {}

void Canvas::blend(int x, int y, const Ink& ink) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  Color& c = color(x, y);
  c += ink.opacity * (ink.color - c);
  float& a = alpha(x, y);
  a += ink.opacity * (1.0f - a);
}

void Canvas::rectangle(const Pixel& low, const Pixel& high, const Ink& ink) {
  for (int y = static_cast<int>(std::floor(low.y())); y < high.y(); ++y) {
    const float v = std::min<float>(y + 1, high.y()) - std::max<float>(y, low.y());
    for (int x = static_cast<int>(std::floor(low.x())); x < high.x(); ++x) {
      const float u = std::min<float>(x + 1, high.x()) - std::max<float>(x, low.x());
      blend(x, y, {ink.color, ink.opacity * u * v});
    }
  }
}

void Canvas::ellipse(const Pixel& centre, const Pixel& radii, float turn, const Ink& ink) {
  const float reach = radii.maxCoeff() + 1.0f;
  const float c = std::cos(turn);
  const float s = std::sin(turn);
  for (int y = static_cast<int>(std::floor(centre.y() - reach)); y <= centre.y() + reach; ++y) {
    for (int x = static_cast<int>(std::floor(centre.x() - reach)); x <= centre.x() + reach; ++x) {
      const float dx = x + 0.5f - centre.x();
      const float dy = y + 0.5f - centre.y();
      const float u = (c * dx + s * dy) / radii.x();
      const float v = (-s * dx + c * dy) / radii.y();
      const float edge = (1.0f - std::sqrt(u * u + v * v)) * radii.minCoeff() + 0.5f;
      if (edge > 0.0f) blend(x, y, {ink.color, ink.opacity * std::min(edge, 1.0f)});
    }
  }
}

void Canvas::polygon(const std::vector<Pixel>& corners, const Ink& ink) {
  Pixel low = corners.front();
  Pixel high = corners.front();
  for (const Pixel& p : corners) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  low = low.cwiseMax(Pixel::Zero());
  high = high.cwiseMin(Pixel(width_ - 1, height_ - 1));
  for (int y = static_cast<int>(low.y()); y <= high.y(); ++y) {
    for (int x = static_cast<int>(low.x()); x <= high.x(); ++x) {
      int hits = 0;
      for (int k = 0; k < 4; ++k)
        hits += inside(corners, {x + 0.25f + 0.5f * (k % 2), y + 0.25f + 0.5f * (k / 2)});
      if (hits > 0) blend(x, y, {ink.color, ink.opacity * 0.25f * hits});
    }
  }
}

void Canvas::line(const std::vector<Pixel>& points, float width, const Ink& ink) {
  const float half = 0.5f * width;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Pixel& a = points[i];
    const Pixel& b = points[i + 1];
    const Pixel low = (a.cwiseMin(b).array() - half - 1.0f).cwiseMax(0.0f);
    const Pixel high = (a.cwiseMax(b).array() + half + 1.0f).min(Eigen::Array2f(width_ - 1, height_ - 1));
    for (int y = static_cast<int>(low.y()); y <= high.y(); ++y) {
      for (int x = static_cast<int>(low.x()); x <= high.x(); ++x) {
        const Pixel p(x + 0.5f, y + 0.5f);
        const float cover = half + 0.5f - distanceTo(p, a, b);
        // A pixel nearer to the segment before was painted with that one.
        if (cover <= 0.0f || (i > 0 && half + 0.5f - distanceTo(p, points[i - 1], a) >= cover)) continue;
        blend(x, y, {ink.color, ink.opacity * std::min({cover, 1.0f, width})});
      }
    }
  }
}

void Canvas::mottle(float wavelength_px, float strength, std::uint32_t seed) {
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x)
      color(x, y) *= std::max(0.0f, 1.0f + strength * fractal(x / wavelength_px, y / wavelength_px, 4, seed));
  }
}

void Canvas::streaks(int count, float opacity, Random& random) {
  for (int i = 0; i < count; ++i) {
    const float x = random.range(0.0f, static_cast<float>(width_));
    const float width = random.range(1.0f, 0.02f * width_ + 2.0f);
    const float end = height_ * random.range(0.1f, 0.9f);
    const float strength = opacity * random.unit();
    for (int y = 0; y < end; ++y) {
      const float fade = strength * (1.0f - y / end);
      const float shift = 2.0f * noise(0.03f * y, static_cast<float>(i), 5u);
      rectangle({x + shift, static_cast<float>(y)}, {x + shift + width, y + 1.0f},
                {{0.05f, 0.045f, 0.035f}, fade});
    }
  }
}

Texture Canvas::texture(const std::string& name) const {
  Texture texture;
  texture.name = name;
  texture.width = width_;
  texture.height = height_;
  std::vector<std::uint8_t>& rgba = texture.rgba.own();
  rgba.resize(colors_.size() * 4);
  for (std::size_t i = 0; i < colors_.size(); ++i) {
    for (int c = 0; c < 3; ++c) rgba[4 * i + c] = encode(colors_[i][c]);
    rgba[4 * i + 3] = static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(alphas_[i], 0.0f, 1.0f)));
  }
  return texture;
}

Pixel scatter(Random& random) {
  const float y = random.bell();
  const float x = random.bell();
  return {x, y};
}

Color srgb(int red, int green, int blue) {
  const auto decode = [](int value) { return linearFromSrgb(static_cast<float>(value) / 255.0f); };
  return {decode(red), decode(green), decode(blue)};
}

}  // namespace sunlit::scene::race_track
