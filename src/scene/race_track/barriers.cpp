#include "scene/race_track/barriers.h"

#include <cmath>

#include "scene/race_track/fence.h"
#include "scene/race_track/ground.h"
#include "scene/race_track/layout.h"
#include "scene/race_track/poster.h"
#include "scene/race_track/shapes.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::scene::race_track {
namespace {

Point barrierPoint(double along, int side, double behind = 0.0) {
  return groundPoint(TrackPlace{along, side * (barrierOffset(along, side) + behind)});
}

// Unit vector from the barrier to the track.
Point inward(double along, int side) {
  const Eigen::Vector2d left = leftOf(course().tangent(along));
  return Eigen::Vector3d(-side * left.x(), -side * left.y(), 0.0).cast<float>();
}

// Corners of a face whose front looks at the track, whichever side it is on.
Corners facingTrack(int side, const Corners& c) {
  return side > 0 ? c : Corners{c[1], c[0], c[3], c[2]};
}

void addGuardRail(Assembly& assembly, const BarrierStretch& stretch, Random& random) {
  constexpr double kStep_m = 2.0;
  constexpr float kProfile[][2] = {
      {0.0f, 0.42f}, {0.08f, 0.50f}, {0.02f, 0.58f}, {0.08f, 0.67f}, {0.0f, 0.75f}};
  for (double s = stretch.from; s < stretch.to - 0.1; s += kStep_m) {
    const double next = std::min(s + kStep_m, stretch.to);
    const Point a = barrierPoint(s, stretch.side);
    const Point b = barrierPoint(next, stretch.side);
    const Point in = inward(s, stretch.side);
    const Point in_next = inward(next, stretch.side);
    const float age = random.range(0.65f, 1.15f);
    const bool rusty = random.chance(0.12f);
    const Color color = (rusty ? Color(0.26f, 0.19f, 0.14f) : Color(0.36f, 0.37f, 0.38f)) * age;
    const float dent = random.chance(0.15f) ? random.range(-0.10f, 0.02f) : 0.0f;
    for (int k = 0; k + 1 < 5; ++k) {
      const auto at = [&](const Point& p, const Point& towards, int i) {
        return Point(p + (kProfile[i][0] + dent) * towards + Point(0, 0, kProfile[i][1]));
      };
      addQuad(assembly, {assembly.palette().metal, color},
              facingTrack(stretch.side,
                          {at(a, in, k), at(b, in_next, k), at(b, in_next, k + 1), at(a, in, k + 1)}));
    }
    const Paint post{assembly.palette().metal, Color(0.28f, 0.28f, 0.28f) * random.range(0.7f, 1.2f)};
    const float yaw = std::atan2(in.y(), in.x());
    const float height = 1.08f + 0.04f * random.unit();
    addBox(assembly, post, standing(a - 0.10f * in - Point(0, 0, 0.3f), yaw + 0.05f * random.bell()),
           {0.10f, 0.08f, height});
  }
}

void addConcrete(Assembly& assembly, const BarrierStretch& stretch, Random& random) {
  constexpr double kBlock_m = 3.95;
  for (double s = stretch.from; s + kBlock_m < stretch.to + 0.1; s += kBlock_m + 0.05) {
    const Point a = barrierPoint(s, stretch.side);
    const Point b = barrierPoint(s + kBlock_m, stretch.side);
    const Point in = inward(s + 0.5 * kBlock_m, stretch.side);
    const Color tone = Color(0.33f, 0.32f, 0.29f) * random.range(0.65f, 1.15f);
    const Paint paint{assembly.palette().concrete, tone};
    const float shift = 0.03f * random.bell();
    // Foot, slope and face in (inwards, up), then the back.
    const float profile[][2] = {{0.30f, -0.3f}, {0.30f, 0.10f},  {0.12f, 0.36f},
                                {0.08f, 0.92f}, {-0.08f, 0.92f}, {-0.28f, -0.3f}};
    const auto at = [&](const Point& p, int i) {
      return Point(p + (profile[i][0] + shift) * in + Point(0, 0, profile[i][1]));
    };
    for (int k = 0; k + 1 < 6; ++k)
      addQuad(assembly, paint, facingTrack(stretch.side, {at(a, k), at(b, k), at(b, k + 1), at(a, k + 1)}));
    for (const Point& end : {a, b}) {
      addQuad(assembly, paint, {at(end, 0), at(end, 1), at(end, 2), at(end, 5)});
      addQuad(assembly, paint, {at(end, 2), at(end, 3), at(end, 4), at(end, 5)});
    }
    if (random.chance(0.75f)) {
      const Picture picture = assembly.addPicture(paintPoster({256, 44}, random.bits()));
      const Point lift = 0.012f * in;
      const Point along = (b - a).normalized();
      const float left_gap = random.range(0.15f, 0.4f);
      Corners face = {at(a, 2) + lift + left_gap * along + Point(0, 0, 0.04f),
                      at(b, 2) + lift - 0.2f * along + Point(0, 0, 0.04f),
                      at(b, 3) + lift - 0.2f * along - Point(0, 0, 0.04f),
                      at(a, 3) + lift + left_gap * along - Point(0, 0, 0.04f)};
      addQuad(assembly, {picture.material, Color::Ones()}, facingTrack(stretch.side, face), picture.rect);
    } else {
      // A painted top.
      const Point lift(0, 0, 0.008f);
      addQuad(
          assembly, {assembly.palette().matte, paintColor(random)},
          facingTrack(stretch.side, {at(a, 3) + lift, at(b, 3) + lift, at(b, 4) + lift, at(a, 4) + lift}));
    }
  }
}

void addTyres(Assembly& assembly, const BarrierStretch& stretch, Random& random) {
  constexpr double kPitch_m = 0.66;
  for (double s = stretch.from; s < stretch.to; s += kPitch_m) {
    const Point place = barrierPoint(s, stretch.side) + sway(0.02f, random);
    addTyreStack(assembly, place, random.chance(0.85f) ? 4 : 3, random);
  }
}

void addHay(Assembly& assembly, const BarrierStretch& stretch, Random& random) {
  for (double s = stretch.from; s < stretch.to; s += 1.16) {
    const Point in = inward(s, stretch.side);
    const float yaw = std::atan2(in.y(), in.x()) + 0.5f * kPiFloat;
    const int layers = 1 + random.below(2);
    for (int k = 0; k < layers; ++k) {
      const Color tone = Color(0.34f, 0.26f, 0.11f) * random.range(0.6f, 1.25f);
      const Point place =
          barrierPoint(s + 0.15 * random.bell(), stretch.side) + Point(0, 0, 0.47f * k - 0.03f);
      const Frame frame = standing(place, yaw + 0.10f * random.bell());
      addBox(assembly, {assembly.palette().straw, tone}, frame, {random.range(0.98f, 1.12f), 0.52f, 0.47f});
      for (const float x : {-0.28f, 0.27f})
        addBox(assembly, {assembly.palette().matte, {0.30f, 0.09f, 0.04f}}, shifted(frame, {x, 0, -0.005f}),
               {0.02f, 0.535f, 0.485f});
    }
  }
}

void addTimber(Assembly& assembly, const BarrierStretch& stretch, Random& random) {
  for (double s = stretch.from; s < stretch.to; s += 2.4) {
    const Point a = barrierPoint(s, stretch.side);
    const Point b = barrierPoint(std::min(s + 2.4, stretch.to), stretch.side);
    const Paint wood{assembly.palette().wood, Color(0.23f, 0.16f, 0.10f) * random.range(0.6f, 1.4f)};
    const Point up(0, 0, random.range(1.05f, 1.2f));
    const Point top = a + (sway(0.02f, random) + up);
    addTube(assembly, wood, {{a - Point(0, 0, 0.3f), 0.07f}, {top, 0.06f}}, 7);
    for (const float z : {0.45f, 0.95f}) {
      const Paint rail{assembly.palette().wood, Color(0.26f, 0.19f, 0.12f) * random.range(0.6f, 1.3f)};
      addTube(assembly, rail,
              {{a + Point(0, 0, z + 0.03f * random.bell()), 0.045f},
               {b + Point(0, 0, z + 0.03f * random.bell()), 0.045f}},
              6);
    }
  }
}

}  // namespace

void addTyreStack(Assembly& assembly, const Eigen::Vector3f& place, int count, Random& random) {
  float z = -0.02f;
  for (int k = 0; k < count; ++k) {
    const float roll = random.unit();
    const Color color = roll < 0.62f   ? Color(0.035f, 0.034f, 0.033f) * random.range(0.7f, 1.8f)
                        : roll < 0.80f ? Color(0.55f, 0.54f, 0.50f) * random.range(0.5f, 1.0f)
                        : roll < 0.93f ? Color(0.40f, 0.04f, 0.03f) * random.range(0.6f, 1.1f)
                                       : paintColor(random);
    const float thickness = random.range(0.19f, 0.23f);
    const Point middle = place + sway(0.02f, random);
    const float r = random.range(0.29f, 0.32f);
    const auto ring = [&](float up, float radius) {
      return Ring{middle + Point(0, 0, z + up * thickness), radius};
    };
    std::vector<Ring> rings = {ring(0.02f, 0.86f * r), ring(0.45f, r), ring(0.98f, 0.86f * r)};
    // The hole shows on the uppermost only.
    if (k + 1 == count) rings.insert(rings.end(), {ring(0.99f, 0.6f * r), ring(0.55f, 0.55f * r)});
    addTube(assembly, {assembly.palette().rubber, color}, rings, 8);
    z += thickness;
  }
}

void addBarriers(Assembly& assembly) {
  std::uint32_t index = 0;
  for (const BarrierStretch& stretch : barriers()) {
    Random random(611u, index++);
    switch (stretch.kind) {
      case BarrierKind::kGuardRail:
        addGuardRail(assembly, stretch, random);
        break;
      case BarrierKind::kConcrete:
        addConcrete(assembly, stretch, random);
        break;
      case BarrierKind::kTyres:
        addTyres(assembly, stretch, random);
        break;
      case BarrierKind::kHay:
        addHay(assembly, stretch, random);
        break;
      case BarrierKind::kTimber:
        addTimber(assembly, stretch, random);
        break;
      case BarrierKind::kNone:
        break;
    }
  }
  addFences(assembly);
}

}  // namespace sunlit::scene::race_track
