#include "render/looks_paint.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/detail.h"

namespace sunlit::render {
namespace {

/// The 8-bit code of a linear value, 0 … 1, of which dark codes are some 20 steps of the table wide.
const std::vector<std::uint8_t>& codes() {
  static const std::vector<std::uint8_t> table = [] {
    std::vector<std::uint8_t> made(65536);
    for (std::size_t i = 0; i < made.size(); ++i) {
      const double linear = static_cast<double>(i) / 65535.0;  // IEC 61966-2-1
      const double code = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
      made[i] = static_cast<std::uint8_t>(std::lround(255.0 * code));
    }
    return made;
  }();
  return table;
}

/// A triangle of a chart in its plane.
class Flat {
 public:
  Flat(const scene::Mesh& mesh, std::uint32_t triangle, const Chart& chart) {
    const auto& v = mesh.triangles[triangle];
    for (std::size_t k = 0; k < 3; ++k) {
      corners_[k] = chart.on(mesh.positions[v[k]]);
      if (!mesh.colors.empty()) colors_[k] = mesh.colors[v[k]];
      if (!mesh.texture_coordinates.empty()) coordinates_[k] = mesh.texture_coordinates[v[k]].array();
    }
    const Eigen::Array2f b = corners_[1] - corners_[0], c = corners_[2] - corners_[0];
    const float area = b[0] * c[1] - b[1] * c[0];
    inverse_ = std::abs(area) > 1e-20f ? 1.0f / area : 0.0f;
  }

  Eigen::Array3f shares(const Eigen::Array2f& at) const {
    const Eigen::Array2f b = corners_[1] - corners_[0], c = corners_[2] - corners_[0], p = at - corners_[0];
    const float u = (p[0] * c[1] - p[1] * c[0]) * inverse_, v = (b[0] * p[1] - b[1] * p[0]) * inverse_;
    return {1.0f - u - v, u, v};
  }
  Eigen::Array3f color(const Eigen::Array3f& s) const {
    return s[0] * colors_[0] + s[1] * colors_[1] + s[2] * colors_[2];
  }
  Eigen::Array2f coordinates(const Eigen::Array3f& s) const {
    return s[0] * coordinates_[0] + s[1] * coordinates_[1] + s[2] * coordinates_[2];
  }

 private:
  std::array<Eigen::Array2f, 3> corners_;
  std::array<Eigen::Array3f, 3> colors_{Eigen::Array3f::Ones(), Eigen::Array3f::Ones(),
                                        Eigen::Array3f::Ones()};
  std::array<Eigen::Array2f, 3> coordinates_{Eigen::Array2f::Zero(), Eigen::Array2f::Zero(),
                                             Eigen::Array2f::Zero()};
  float inverse_ = 0.0f;
};

/// Texels of `size` that a step of one texel of the chart goes over, the larger of its two.
float texelsAStep(const Flat& flat, const Eigen::Array2f& step, const Eigen::Array2f& size) {
  const Eigen::Array2f zero = flat.coordinates(flat.shares({0.0f, 0.0f}));
  const Eigen::Array2f right = flat.coordinates(flat.shares({step[0], 0.0f})) - zero;
  const Eigen::Array2f up = flat.coordinates(flat.shares({0.0f, step[1]})) - zero;
  return std::max((right * size).matrix().norm(), (up * size).matrix().norm());
}

class Painter {
 public:
  Painter(const scene::Scene& scene, const TexturePyramid* texture, const Chart& chart)
      : chart_(chart), texture_(texture), step_(chart.step_m()) {
    const scene::Mesh& mesh = scene.meshes[chart.mesh];
    const scene::Material& material = scene.materials[static_cast<std::size_t>(mesh.material)];
    base_ = material.base_color.value;
    tint_ = material.detail.tint;
    for (std::uint32_t k = 0; k < chart.count; ++k) flats_.emplace_back(mesh, chart.triangle + k, chart);
    if (texture && !mesh.texture_coordinates.empty()) {
      for (const Flat& flat : flats_)
        levels_.push_back(std::log2(std::max(texelsAStep(flat, step_, texture->size()), 1.0f)));
    } else {
      texture_ = nullptr;
    }
  }

  /// Without its detail.
  Eigen::Array3f plain(const Eigen::Array2f& at) const {
    std::size_t best = 0;
    Eigen::Array3f shares = flats_[0].shares(at);
    for (std::size_t k = 1; k < flats_.size(); ++k) {
      const Eigen::Array3f other = flats_[k].shares(at);
      if (other.minCoeff() <= shares.minCoeff()) continue;
      shares = other;
      best = k;
    }
    // Beyond the edge as at the edge.
    shares = shares.max(0.0f);
    shares /= std::max(shares.sum(), 1e-12f);
    Eigen::Array3f color = base_ * flats_[best].color(shares);
    if (texture_) color *= texture_->color(flats_[best].coordinates(shares), levels_[best]);
    return color.max(0.0f).min(1.0f);
  }
  const Eigen::Array3f& tint() const { return tint_; }

 private:
  const Chart& chart_;
  const TexturePyramid* texture_;
  Eigen::Array2f step_;
  Eigen::Array3f base_, tint_;
  std::vector<Flat> flats_;
  std::vector<float> levels_;  ///< of the texture, of each of flats_
};

}  // namespace

void paintChart(const scene::Scene& scene, const TexturePyramid* texture, const Chart& chart,
                scene::Texture* page) {
  const scene::Mesh& mesh = scene.meshes[chart.mesh];
  const scene::Detail& detail = scene.materials[static_cast<std::size_t>(mesh.material)].detail;
  const Painter painter(scene, texture, chart);
  const DetailOctaves octaves(detail, chart.origin.cast<double>());
  const Eigen::Array2f step = chart.step_m();
  const std::vector<std::uint8_t>& code = codes();
  const int width = chart.room[0], height = chart.room[1];
  constexpr int kLanes = DetailPoints::kCount;
  for (int y = 0; y < height; ++y) {
    std::uint8_t* texel = page->rgba.own().data() +
                          4 * (static_cast<std::size_t>(chart.y + y) * static_cast<std::size_t>(page->width) +
                               static_cast<std::size_t>(chart.x));
    for (int begin = 0; begin < width; begin += kLanes) {
      std::array<Eigen::Array2f, kLanes> at;
      DetailPoints points;
      for (int i = 0; i < kLanes; ++i) {
        const auto lane = static_cast<std::size_t>(i);
        at[lane] = (Eigen::Array2f(static_cast<float>(begin + i), static_cast<float>(y)) + 0.5f -
                    static_cast<float>(chart.gutter())) *
                   step;
        const Eigen::Vector3f place = at[lane][0] * chart.right + at[lane][1] * chart.up;
        points.x[lane] = place.x();
        points.y[lane] = place.y();
        points.z[lane] = place.z();
        points.footprint[lane] = step.maxCoeff();
        points.spread[lane] = 0.0f;
      }
      std::array<float, kLanes> sums{};
      if (octaves.count > 0) sumOctaves(octaves, points, &sums);
      for (int i = 0; i < std::min(kLanes, width - begin); ++i, texel += 4) {
        const auto lane = static_cast<std::size_t>(i);
        const Eigen::Array3f color =
            (painter.plain(at[lane]) * (1.0f + painter.tint() * sums[lane])).max(0.0f).min(1.0f);
        for (int c = 0; c < 3; ++c)
          texel[c] = code[static_cast<std::size_t>(std::lround(65535.0f * color[c]))];
        texel[3] = 255;
      }
    }
  }
}

double ownTexel(const scene::Mesh& mesh, const scene::Texture& texture, const Chart& chart) {
  const Eigen::Array2f size(static_cast<float>(texture.width), static_cast<float>(texture.height));
  const Eigen::Array2f metre(1.0f, 1.0f);
  double finest = 1e9;
  for (std::uint32_t k = 0; k < chart.count; ++k) {
    const Flat flat(mesh, chart.triangle + k, chart);
    finest = std::min(finest, 1.0 / std::max(static_cast<double>(texelsAStep(flat, metre, size)), 1e-9));
  }
  return finest;
}

}  // namespace sunlit::render
