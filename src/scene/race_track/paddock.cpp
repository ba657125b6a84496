#include <cmath>

#include "scene/race_track/furniture.h"
#include "scene/race_track/ground.h"
#include "scene/race_track/layout.h"
#include "scene/race_track/poster.h"
#include "scene/race_track/vehicles.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::scene::race_track {
namespace {

// Axes of a crossing at `along`: x to the left, y onwards.
Frame crossing(double along) {
  const Eigen::Vector2d t = course().tangent(along);
  return standing(groundPoint(TrackPlace{along, 0.0}),
                  std::atan2(static_cast<float>(t.y()), static_cast<float>(t.x())) + 0.5f * kPiFloat);
}

struct Girder {
  Point from;
  Point to;
  float size;  // of its square section
};

// A lattice girder: four chords and zigzag braces.
void addGirder(Assembly& assembly, const Frame& frame, const Girder& span, const Paint& paint) {
  const Point axis = (span.to - span.from).normalized();
  const Point u = std::abs(axis.z()) > 0.9f ? Point::UnitX() : Point::UnitZ();
  const Point v = axis.cross(u);
  const float h = 0.5f * span.size;
  const Point corners[4] = {h * (u + v), h * (u - v), -h * (u + v), -h * (u - v)};
  for (const Point& c : corners)
    addBar(assembly, paint, {frame * Point(span.from + c), 0.05f}, {frame * Point(span.to + c), 0.05f});
  const int bays = std::max(1, static_cast<int>((span.to - span.from).norm() / span.size));
  for (int i = 0; i < bays; ++i) {
    const Point a = span.from + (span.to - span.from) * static_cast<float>(i) / static_cast<float>(bays);
    const Point b = span.from + (span.to - span.from) * static_cast<float>(i + 1) / static_cast<float>(bays);
    for (int k = 0; k < 4; ++k)
      addBar(assembly, paint, {frame * Point(a + corners[k]), 0.025f},
             {frame * Point(b + corners[(k + 1) % 4]), 0.025f});
  }
}

// Boards on a beam across the track, to be read by drivers (who look to +y).
void addCrossBoards(Assembly& assembly, const Frame& frame, const Girder& span, std::uint32_t seed) {
  Random random(seed);
  const float length = (span.to - span.from).norm();
  const int count = std::max(1, static_cast<int>(length / 4.5f));
  const float y = span.from.y() - 0.5f * span.size - 0.06f;
  for (int i = 0; i < count; ++i) {
    // From left to right as seen by drivers, who see +x on their left.
    const float x0 = span.to.x() - length * static_cast<float>(i) / static_cast<float>(count) - 0.06f;
    const float x1 = span.to.x() - length * static_cast<float>(i + 1) / static_cast<float>(count) + 0.06f;
    const float z = span.from.z();
    const Picture picture = assembly.addPicture(paintPoster({224, 64}, random.bits()));
    addQuad(assembly, {picture.material, Color::Ones()},
            {frame * Point(x0, y, z - 0.6f), frame * Point(x1, y, z - 0.6f), frame * Point(x1, y, z + 0.65f),
             frame * Point(x0, y, z + 0.65f)},
            picture.rect);
  }
}

void addGantry(Assembly& assembly) {
  const Frame frame = crossing(3.0);
  const Paint steel{assembly.palette().metal, {0.48f, 0.49f, 0.50f}};
  for (const float x : {-9.6f, 9.6f}) addGirder(assembly, frame, {{x, 0, -0.5f}, {x, 0, 6.6f}, 0.7f}, steel);
  const Girder beam{{-9.6f, 0, 6.0f}, {9.6f, 0, 6.0f}, 0.9f};
  addGirder(assembly, frame, beam, steel);
  addCrossBoards(assembly, frame, beam, 901u);
  // The five start lights.
  for (int i = -2; i <= 2; ++i) {
    const Frame box = shifted(frame, {0.55f * static_cast<float>(i), -0.3f, 4.6f});
    addBox(assembly, {assembly.palette().matte, {0.02f, 0.02f, 0.02f}}, box, {0.42f, 0.25f, 0.85f});
    for (const float z : {0.22f, 0.62f})
      addTube(assembly, {assembly.palette().glass, {0.30f, 0.02f, 0.02f}},
              {{box * Point(0, -0.1f, z), 0.14f}, {box * Point(0, -0.16f, z), 0.14f}}, 10);
  }
}

// A footbridge on concrete piers.
void addFootbridge(Assembly& assembly, double along, std::uint32_t seed) {
  Random random(seed);
  const Palette& p = assembly.palette();
  const Frame frame = crossing(along);
  const Color tone = Color(0.34f, 0.33f, 0.30f) * random.range(0.8f, 1.1f);
  const float reach = 13.0f;
  for (const float x : {-10.6f, 10.6f})
    addBox(assembly, {p.concrete, tone}, shifted(frame, {x, 0, -1.0f}), {0.9f, 1.6f, 6.2f});
  for (float x = -reach; x < reach - 0.1f; x += 2.6f)
    addBox(assembly, {p.concrete, tone * random.range(0.85f, 1.1f)}, shifted(frame, {x + 1.3f, 0, 5.2f}),
           {2.58f, 2.4f, 0.45f});
  addCrossBoards(assembly, frame, {{-10.0f, 0, 5.9f}, {10.0f, 0, 5.9f}, 2.5f}, seed + 1u);
  for (const float y : {-1.1f, 1.1f}) {
    for (float x = -reach; x <= reach; x += 1.3f)
      addBar(assembly, {p.metal, {0.30f, 0.33f, 0.30f}}, {frame * Point(x, y, 5.6f), 0.025f},
             {frame * Point(x, y, 6.75f), 0.025f});
    addBar(assembly, {p.metal, {0.30f, 0.33f, 0.30f}}, {frame * Point(-reach, y, 6.75f), 0.035f},
           {frame * Point(reach, y, 6.75f), 0.035f});
  }
  // Stairs at both ends, down away from the track.
  for (const float side : {-1.0f, 1.0f}) {
    for (int k = 0; k < 18; ++k) {
      const float t = static_cast<float>(k);
      addBox(assembly, {p.concrete, tone},
             shifted(frame, {side * (reach + 0.3f * t + 0.15f), 0, 5.35f - 0.31f * t - 0.3f}),
             {0.32f, 1.8f, 0.3f});
    }
  }
}

// An arch like half a tyre.
void addArch(Assembly& assembly, double along) {
  const Frame frame = crossing(along);
  constexpr int kParts = 22;
  Random random(911u);
  const auto at = [&](int k, float radius, float y) {
    const float angle = kPiFloat * static_cast<float>(k) / kParts;
    return Point(frame * Point(1.45f * radius * std::cos(angle), y, radius * std::sin(angle) - 0.3f));
  };
  for (int k = 0; k < kParts; ++k) {
    const Paint tread{assembly.palette().rubber, Color(0.05f, 0.05f, 0.05f) * random.range(0.7f, 1.4f)};
    const Paint wall{
        assembly.palette().matte,
        (k % 6 < 3 ? Color(0.55f, 0.38f, 0.04f) : Color(0.08f, 0.08f, 0.09f)) * random.range(0.8f, 1.1f)};
    addQuad(assembly, tread,
            {at(k, 8.0f, -0.7f), at(k + 1, 8.0f, -0.7f), at(k + 1, 8.0f, 0.7f), at(k, 8.0f, 0.7f)});
    addQuad(assembly, tread,
            {at(k + 1, 6.9f, -0.7f), at(k, 6.9f, -0.7f), at(k, 6.9f, 0.7f), at(k + 1, 6.9f, 0.7f)});
    addQuad(assembly, wall,
            {at(k, 6.9f, -0.7f), at(k, 8.0f, -0.7f), at(k + 1, 8.0f, -0.7f), at(k + 1, 6.9f, -0.7f)});
    addQuad(assembly, wall,
            {at(k, 8.0f, 0.7f), at(k, 6.9f, 0.7f), at(k + 1, 6.9f, 0.7f), at(k + 1, 8.0f, 0.7f)});
  }
}

void addTent(Assembly& assembly, const Frame& frame, Random& random) {
  const float w = random.range(2.0f, 3.2f);
  const Palette& p = assembly.palette();
  const Color a = paintColor(random);
  const Color b = random.chance(0.5f) ? a : Color(0.62f, 0.61f, 0.58f);
  const Point top = frame * Point(0, 0, 3.7f);
  const Point eaves[4] = {frame * Point(-w, -w, 2.3f), frame * Point(w, -w, 2.3f), frame * Point(w, w, 2.3f),
                          frame * Point(-w, w, 2.3f)};
  for (int k = 0; k < 4; ++k) {
    const Point& c = eaves[k];
    const Point& d = eaves[(k + 1) % 4];
    addTriangle(assembly, {p.cloth, (k % 2 ? a : b) * random.range(0.85f, 1.1f)}, {c, d, top});
    const Point drop(0, 0, -0.35f);
    addQuad(assembly, {p.cloth, a * 0.9f}, {c + drop, d + drop, d, c});
    addBar(assembly, {p.metal, {0.5f, 0.5f, 0.5f}}, {c - Point(0, 0, 2.7f), 0.035f}, {c, 0.035f});
  }
  const Picture banner = assembly.addPicture(paintPoster({128, 56}, random.bits()));
  addQuad(assembly, {banner.material, Color::Ones()},
          {frame * Point(-0.9f * w, w - 0.05f, 0.2f), frame * Point(0.9f * w, w - 0.05f, 0.2f),
           frame * Point(0.9f * w, w - 0.05f, 2.2f), frame * Point(-0.9f * w, w - 0.05f, 2.2f)},
          banner.rect);
  addBox(assembly, {p.wood, {0.35f, 0.28f, 0.18f}}, shifted(frame, {0.3f * w, -0.3f * w, -0.05f}),
         {1.6f, 0.7f, 0.8f});
}

void addYard(Assembly& assembly, const Plot& plot, std::uint32_t seed) {
  Random random(seed);
  const int side = plot.place.left > 0.0 ? 1 : -1;
  const double near = barrierOffset(plot.place.along, side) + 4.5;
  for (int row = 0; row < 3; ++row) {
    for (double u = -plot.radius + 4.0; u < plot.radius - 3.0; u += row == 0 ? 6.5 : 7.5) {
      const TrackPlace place{plot.place.along + u + random.bell() * 0.4,
                             side * (near + 7.5 * row + 0.5 * random.bell())};
      const Eigen::Vector2d t = course().tangent(place.along);
      const float yaw = std::atan2(static_cast<float>(t.y()), static_cast<float>(t.x()));
      const float parked = yaw + (random.chance(0.5f) ? kPiFloat : 0.0f);
      const float turned = parked + 0.15f * random.bell();
      const Frame frame = standing(groundPoint(place) - Point(0, 0, 0.03f), turned);
      const int kind = random.below(10);
      const std::uint32_t own = random.bits();
      if (kind < 4) {
        addTent(assembly,
                standing(groundPoint(place), yaw + (side > 0 ? 0.0f : kPiFloat) + 0.1f * random.bell()),
                random);
      } else if (kind < 7) {
        addCar(assembly, frame, own);
      } else if (kind < 9) {
        addVan(assembly, frame, own);
      } else {
        addLorry(assembly, frame, own);
      }
    }
  }
}

}  // namespace

void addBridges(Assembly& assembly) {
  addGantry(assembly);
  addFootbridge(assembly, 262.0, 921u);
  addFootbridge(assembly, 664.0, 931u);
  addArch(assembly, 492.0);
}

void addPaddocks(Assembly& assembly) {
  std::uint32_t seed = 941u;
  for (const Plot& plot : plots()) {
    ++seed;
    if (plot.kind == Plot::Kind::kPaddock) addYard(assembly, plot, seed);
    if (plot.kind != Plot::Kind::kHouse && plot.kind != Plot::Kind::kBarn) continue;
    // A car beside the house.
    Random random(seed, 7u);
    const int side = plot.place.left > 0.0 ? 1 : -1;
    const TrackPlace place{plot.place.along + (random.chance(0.5f) ? 8.5 : -8.5),
                           plot.place.left - 4.0 * side};
    const Frame frame =
        standing(groundPoint(place) - Point(0, 0, 0.02f), random.range(0.0f, 2.0f * kPiFloat));
    (random.chance(0.6f) ? addCar : addVan)(assembly, frame, random.bits());
  }
}

}  // namespace sunlit::scene::race_track
