#include <cmath>

#include "scene/race_track/ground.h"
#include "scene/race_track/layout.h"
#include "scene/race_track/plants.h"
#include "scene/race_track/road.h"
#include "scene/race_track/shapes.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::scene::race_track {
namespace {

struct Tuft {
  Point root;
  float height;
  Color tint;
};

// Two cards that lean apart, each seen from above only: so whoever looks sees the side that the sky lights,
// and the turf does not turn black when one looks towards the sun.
void addTuft(Assembly& assembly, const Picture& picture, const Tuft& tuft, Random& random) {
  const float width = tuft.height * random.range(1.7f, 3.0f);
  const float turn = random.range(0.0f, 2.0f * kPiFloat);
  for (int i = 0; i < 2; ++i) {
    const float angle = turn + kPiFloat * static_cast<float>(i) + random.range(-0.3f, 0.3f);
    const float lean = random.range(0.62f, 0.85f);
    const Point half(0.5f * width * std::cos(angle), 0.5f * width * std::sin(angle), 0.0f);
    const Point back(-std::sin(angle), std::cos(angle), 0.0f);
    const Point up = 1.2f * tuft.height * (std::cos(lean) * Point::UnitZ() + std::sin(lean) * back);
    const Point& root = tuft.root;
    Card card{
        {root - half, root + half, root + half + up, root - half + up}, picture.rect, even(Point::UnitZ())};
    if (random.chance(0.5f)) std::swap(card.rect.top_left.x(), card.rect.bottom_right.x());
    addCard(assembly, {picture.material, tuft.tint}, card);
  }
}

}  // namespace

void addGrass(Assembly& assembly, const Foliage& foliage) {
  Random random(501u);
  constexpr int kTuftCount = 15500;
  for (int i = 0; i < kTuftCount; ++i) {
    const int side = random.chance(0.5f) ? 1 : -1;
    const double s = random.unit() * course().length();
    // Denser towards the track.
    const float reach = 9.0f * random.unit();
    const float out = 0.15f + reach * random.unit();
    const double left = side * (kHalfWidth + kerbWidth(s, side) + out);
    const Eigen::Vector2d p = course().point({s, left});
    const float lush = noise(static_cast<float>(p.x()) / 2.2f, static_cast<float>(p.y()) / 2.2f, 502u);
    if (lush < -0.35f + 0.5f * random.bell() * 0.3f) continue;
    const float size =
        (0.05f + 0.11f * smoothStep(0.0f, 3.0f, out)) * (1.0f + 0.7f * lush) * random.range(0.6f, 1.6f);
    const Color turf = turfColor(p);
    const Color tint = (0.45f + 4.5f * turf) * random.range(0.75f, 1.25f);
    const bool flower = random.chance(0.12f + 0.2f * std::max(0.0f, lush));
    const int which = flower ? 4 + random.below(4) : random.below(4);
    Random own(503u, static_cast<std::uint32_t>(i));
    const float height = std::max(0.05f, size);
    // Sunk a little, so that no root hangs in the air.
    const Point root = groundPoint(TrackPlace{s, left}) - Point(0, 0, 0.02f);
    addTuft(assembly, foliage.tufts[which], {root, height, tint.min(1.6f)}, own);
  }
}

void addStones(Assembly& assembly) {
  Random random(511u);
  for (int i = 0; i < 260; ++i) {
    const int side = random.chance(0.5f) ? 1 : -1;
    const double s = random.unit() * course().length();
    const bool near = i < 140;
    const double out = near ? random.range(1.4f, 3.4f) : random.range(10.0f, 30.0f);
    const double left = side * (kHalfWidth + kerbWidth(s, side) + out);
    const std::uint32_t seed = random.bits();
    const float size = near ? random.range(0.02f, 0.10f) : random.range(0.15f, 0.9f);
    const Eigen::Vector2d p = course().point({s, left});
    if (!near && !isFree(p, size)) continue;
    const Color tone = Color(0.24f, 0.22f, 0.195f) * random.range(0.55f, 1.4f);
    const float height = size * random.range(0.45f, 0.8f);
    const float depth = size * random.range(0.7f, 1.3f);
    const Point radii(size * random.range(0.7f, 1.3f), depth, height);
    addLump(assembly, {assembly.palette().stone, tone},
            {groundPoint(p) + Point(0, 0, 0.2f * size), radii, 0.35f, seed});
  }
}

}  // namespace sunlit::scene::race_track
