#include "scene/race_track/fence.h"

#include <cmath>

#include "scene/race_track/ground.h"
#include "scene/race_track/layout.h"
#include "scene/race_track/poster.h"
#include "scene/race_track/shapes.h"

namespace sunlit::scene::race_track {
namespace {

constexpr float kHeight_m = 2.7f;
constexpr float kBay_m = 3.0f;
constexpr float kPicture_m = 2.0f;  // of wire that one picture shows

// Wire that crosses in diamonds, bent here and there, with rust.
int wireMaterial(Assembly& assembly) {
  constexpr int kSize = 512;
  constexpr int kDiamonds = 26;
  Canvas canvas(kSize, kSize, {0.30f, 0.30f, 0.30f}, 0.0f);
  const float pitch = static_cast<float>(kSize) / kDiamonds;
  for (int i = -kDiamonds; i < 2 * kDiamonds; ++i) {
    for (const float slope : {1.0f, -1.0f}) {
      for (int k = 0; k < kDiamonds; ++k) {
        const auto at = [&](int n) {
          const float y = pitch * static_cast<float>(n);
          return Pixel(pitch * static_cast<float>(i) + (slope > 0 ? y : kSize - y), y);
        };
        const float rust = smoothStep(0.2f, 0.7f, fractal(0.01f * at(k).x(), 0.01f * at(k).y(), 3, 621u));
        canvas.line(
            {at(k), at(k + 1)}, 2.0f,
            {Color(0.34f, 0.35f, 0.35f) + rust * (Color(0.20f, 0.11f, 0.06f) - Color(0.34f, 0.35f, 0.35f)),
             1.0f});
      }
    }
  }
  Material material;
  material.name = "wire";
  material.base_color = LinearRgb(1.0f, 1.0f, 1.0f);
  material.base_texture = assembly.addTexture(canvas.texture("wire"));
  material.alpha_mode = AlphaMode::kMask;
  material.alpha_cutoff = 0.3f;
  material.roughness = 0.6f;
  return assembly.addMaterial(std::move(material));
}

struct Bay {
  Point from;
  Point to;
  float along;  // m of wire before it
};

// The net of one bay, hung unevenly, so that no two meshes of it look alike.
void addNet(Assembly& assembly, int wire, const Bay& bay, Random& random) {
  constexpr int kSteps = 4;
  const Point across = (bay.to - bay.from).normalized().cross(Point::UnitZ());
  std::array<std::array<Point, kSteps + 1>, 2> points;
  std::array<std::array<Eigen::Vector2f, kSteps + 1>, 2> places;
  for (int i = 0; i <= kSteps; ++i) {
    const float t = static_cast<float>(i) / kSteps;
    const bool end = i == 0 || i == kSteps;
    for (int k = 0; k < 2; ++k) {
      const float sag = end ? 0.0f : 0.04f * random.bell();
      points[k][i] = bay.from + t * (bay.to - bay.from) + sag * across +
                     Point(0, 0, k * kHeight_m + (end ? 0.0f : 0.03f * random.bell()));
      places[k][i] = {(bay.along + t * kBay_m + 0.03f * random.bell()) / kPicture_m,
                      (k == 0 ? 0.0f : -kHeight_m) / kPicture_m + 0.01f * random.bell()};
    }
  }
  for (int i = 0; i < kSteps; ++i) {
    const Color tint = Color::Constant(random.range(0.6f, 1.2f));
    const PictureRect rect{{places[0][i].x(), places[1][i].y()}, {places[0][i + 1].x(), places[0][i].y()}};
    addQuad(assembly, {wire, tint}, {points[0][i], points[0][i + 1], points[1][i + 1], points[1][i]}, rect);
  }
}

void addBanner(Assembly& assembly, const Bay& bay, int side, Random& random) {
  const Picture picture = assembly.addPicture(paintPoster({256, 104}, random.bits()));
  const Point across = (bay.to - bay.from).normalized().cross(Point::UnitZ()) * (side > 0 ? 0.05f : -0.05f);
  const float low = random.range(0.95f, 1.3f);
  const Point a = bay.from + 0.04f * (bay.to - bay.from) + across;
  const Point b = bay.to - 0.04f * (bay.to - bay.from) + across;
  const Point up(0, 0, low);
  const Point rise(0, 0, 1.15f);
  // Its front looks at the track.
  const Corners face = side < 0 ? Corners{b + up, a + up, a + up + rise, b + up + rise}
                                : Corners{a + up, b + up, b + up + rise, a + up + rise};
  addQuad(assembly, {picture.material, Color::Ones()}, face, picture.rect);
}

}  // namespace

void addFences(Assembly& assembly) {
  const int wire = wireMaterial(assembly);
  std::uint32_t index = 0;
  for (const BarrierStretch& stretch : barriers()) {
    Random random(622u, index++);
    if (!stretch.fence) continue;
    for (double s = stretch.from; s + kBay_m < stretch.to; s += kBay_m) {
      const auto at = [&](double along) {
        return groundPoint(TrackPlace{along, stretch.side * (barrierOffset(along, stretch.side) + 0.9)});
      };
      const Bay bay{at(s), at(s + kBay_m), static_cast<float>(s) * 1.037f};
      const Paint post{assembly.palette().metal, Color(0.30f, 0.31f, 0.31f) * random.range(0.6f, 1.2f)};
      addTube(assembly, post,
              {{bay.from - Point(0, 0, 0.3f), 0.035f},
               {bay.from + Point(0, 0, kHeight_m + 0.1f * random.unit()), 0.035f}},
              6);
      addBar(assembly, post, {bay.from + Point(0, 0, kHeight_m), 0.02f},
             {bay.to + Point(0, 0, kHeight_m), 0.02f});
      addNet(assembly, wire, bay, random);
      if (random.chance(0.28f)) addBanner(assembly, bay, stretch.side, random);
    }
  }
}

}  // namespace sunlit::scene::race_track
