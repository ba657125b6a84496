#include "scene/race_track/road_wear.h"

#include <cmath>

namespace sunlit::scene::race_track {
namespace {

const Color kBitumen(0.030f, 0.029f, 0.028f);

void addPatches(Canvas& canvas, const StretchMap& map) {
  for (std::uint32_t i = 0; i < 70; ++i) {
    Random random(201u, i);
    const double s = map.near(random.unit() * course().length());
    const float length = random.range(0.7f, 6.0f);
    const float width = random.range(0.5f, 2.6f);
    const float left = random.range(-3.9f, 3.9f - width);
    if (!map.sees(s - 1.0, s + length + 1.0)) continue;
    const float tone = random.range(0.045f, 0.17f);
    std::vector<Pixel> corners;
    for (const auto& [u, v] : {std::pair{0.f, 0.f}, {1.f, 0.f}, {1.f, 1.f}, {0.f, 1.f}}) {
      const float aside = left + width * v + random.range(-.1f, .1f);
      corners.push_back(map.at(s + length * u + random.range(-.15f, .15f), aside));
    }
    canvas.polygon(corners, {tone * Color(1.0f, 0.99f, 0.96f), random.range(0.45f, 0.85f)});
    corners.push_back(corners.front());
    const float opacity = random.range(0.3f, 0.9f);
    canvas.line(corners, random.range(1.5f, 4.0f), {kBitumen, opacity});
  }
}

void addCracks(Canvas& canvas, const StretchMap& map) {
  for (std::uint32_t i = 0; i < 620; ++i) {
    Random random(202u, i);
    double s = map.near(random.unit() * course().length());
    double left = random.range(-4.3f, 4.3f);
    if (!map.sees(s - 16.0, s + 16.0)) continue;
    float heading = random.chance(0.5f) ? random.range(-0.4f, 0.4f) : random.range(1.2f, 1.9f);
    const int steps = 4 + random.below(26);
    const bool sealed = random.chance(0.22f);
    std::vector<Pixel> points;
    for (int k = 0; k < steps; ++k) {
      if (std::abs(left) > 4.4) break;
      points.push_back(map.at(s, left));
      heading += random.range(-0.55f, 0.55f);
      s += 0.4 * std::cos(heading);
      left += 0.4 * std::sin(heading);
    }
    if (points.size() < 2) continue;
    const float width = sealed ? random.range(2.0f, 4.0f) : random.range(0.6f, 1.4f);
    canvas.line(points, width, {kBitumen, sealed ? 0.85f : random.range(0.5f, 0.9f)});
  }
}

void addSkids(Canvas& canvas, const StretchMap& map) {
  for (std::uint32_t i = 0; i < 260; ++i) {
    Random random(203u, i);
    const double s = map.near(random.unit() * course().length());
    const float length = random.range(5.0f, 34.0f);
    if (!map.sees(s - 1.0, s + length + 1.0)) continue;
    const float start = static_cast<float>(course().drivingLine(s)) + 1.1f * random.bell();
    const float drift = random.range(-0.07f, 0.07f);
    const float bend = random.range(-0.003f, 0.003f);
    const float gauge = random.range(1.3f, 1.7f);
    const float strength = random.range(0.15f, 0.7f);
    for (int wheel = 0; wheel < (random.chance(0.7f) ? 2 : 1); ++wheel) {
      const float width = random.range(0.12f, 0.26f) * map.perMetreLeft();
      for (float u = 0.0f; u < length; u += 0.5f) {
        const auto place = [&](float v) {
          return map.at(s + v, start + wheel * gauge + drift * v + bend * v * v);
        };
        const float fade =
            std::sin(3.1416f * (u + 0.25f) / length) * (0.7f + 0.3f * noise(u, static_cast<float>(i), 204u));
        canvas.line({place(u), place(u + 0.5f)}, width, {kBitumen, strength * fade});
      }
    }
  }
}

void addStains(Canvas& canvas, const StretchMap& map) {
  for (std::uint32_t i = 0; i < 520; ++i) {
    Random random(205u, i);
    const double s = map.near(random.unit() * course().length());
    if (!map.sees(s - 3.0, s + 3.0)) continue;
    const float left = random.range(-4.2f, 4.2f);
    const float radius = 0.05f + 0.7f * std::pow(random.unit(), 3.0f);
    const Color color = random.chance(0.75f) ? Color(0.04f, 0.038f, 0.036f) : Color(0.22f, 0.20f, 0.17f);
    const float opacity = random.range(0.2f, 0.7f);
    for (int k = 0; k < 4; ++k) {
      const float aside = left + radius * random.bell() * 0.4f;
      const Pixel centre = map.at(s + radius * random.bell() * 0.6f, aside);
      const float across = radius * map.perMetreLeft() * random.range(0.3f, 0.8f);
      const Pixel radii(radius * map.perMetreAlong() * random.range(0.3f, 1.0f), across);
      canvas.ellipse(centre, radii, 0.0f, {color, 0.5f * opacity});
    }
  }
}

void addDebris(Canvas& canvas, const StretchMap& map) {
  for (std::uint32_t i = 0; i < 9000; ++i) {
    Random random(206u, i);
    const double s = map.near(random.unit() * course().length());
    if (!map.sees(s - 0.5, s + 0.5)) continue;
    const bool verge = random.chance(0.6f);
    const float side = !verge || random.chance(0.5f) ? 1.0f : -1.0f;
    const float left = side * (verge ? random.range(3.2f, 6.5f) : random.range(-4.0f, 4.0f));
    const Color leaf[] = {{0.25f, 0.17f, 0.06f},
                          {0.12f, 0.14f, 0.04f},
                          {0.30f, 0.28f, 0.25f},
                          {0.02f, 0.02f, 0.02f},
                          {0.18f, 0.10f, 0.05f}};
    const float across = random.range(0.8f, 2.6f);
    const Pixel radii(random.range(0.5f, 1.3f), across);
    const Ink ink{leaf[random.below(5)], random.range(0.4f, 0.9f)};
    canvas.ellipse(map.at(s, left), radii, random.range(0.0f, 3.0f), ink);
  }
}

void addCovers(Canvas& canvas, const StretchMap& map) {
  for (std::uint32_t i = 0; i < 14; ++i) {
    Random random(207u, i);
    const double s = map.near((i + random.unit()) / 14.0 * course().length());
    if (!map.sees(s - 1.0, s + 1.0)) continue;
    const float side = random.chance(0.5f) ? 1.0f : -1.0f;
    const float left = side * random.range(2.6f, 3.7f);
    const Pixel centre = map.at(s, left);
    const Pixel metre(map.perMetreAlong(), map.perMetreLeft());
    canvas.ellipse(centre, 0.42f * metre, 0.0f, {{0.16f, 0.155f, 0.15f}, 0.9f});
    canvas.ellipse(centre, 0.33f * metre, 0.0f, {{0.05f, 0.048f, 0.046f}, 0.9f});
    for (int k = 0; k < 5; ++k) {
      const float aside = left + random.range(-.2f, .2f);
      canvas.ellipse(map.at(s + random.range(-.2f, .2f), aside), 0.05f * metre, 0.0f,
                     {{0.14f, 0.13f, 0.12f}, 0.9f});
    }
  }
}

}  // namespace

StretchMap::StretchMap(const Canvas& canvas, const RoadStretch& stretch)
    : from_(stretch.from),
      to_(stretch.to),
      along_px_(static_cast<float>(canvas.width() / (stretch.to - stretch.from))),
      left_px_(static_cast<float>(canvas.height() / (2.0 * kPaintedHalfWidth))) {}

double StretchMap::near(double along) const {
  const double length = course().length();
  return along - length * std::round((along - 0.5 * (from_ + to_)) / length);
}

Pixel StretchMap::at(double along, double left) const {
  return {static_cast<float>(along - from_) * along_px_,
          static_cast<float>(kPaintedHalfWidth - left) * left_px_};
}

void addWear(Canvas& canvas, const RoadStretch& stretch) {
  const StretchMap map(canvas, stretch);
  addPatches(canvas, map);
  addCracks(canvas, map);
  addCovers(canvas, map);
  addSkids(canvas, map);
  addStains(canvas, map);
  addDebris(canvas, map);
}

}  // namespace sunlit::scene::race_track
