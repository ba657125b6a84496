#include "light/bake/samples/occupancy.h"

#include <algorithm>
#include <cmath>

namespace sunlit::light {
namespace {

constexpr float kSquare_m = 32.0f;

int step(float coordinate) {
  return static_cast<int>(std::floor(coordinate / kSquare_m));
}

std::uint64_t square(int x, int y) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32 | static_cast<std::uint32_t>(y);
}

/// In a world of `extent_m`: a plain of tens of kilometres must not take all cells that there are.
float emptiestOf(float extent_m) {
  constexpr float kLeast_m = 128.0f, kMost_m = 900.0f, kOfWorld = 0.01f;
  return std::clamp(kOfWorld * extent_m, kLeast_m, kMost_m);
}

}  // namespace

Occupancy::Occupancy(const Geometry& geometry, const std::vector<TriangleTraits>& traits) {
  constexpr float kTerrain_m2 = 60.0f;  ///< larger triangles are no things on the ground, but the ground
  for (std::uint32_t t = 0; t < traits.size(); ++t) {
    if (isLeaf(traits[t].kind)) continue;
    const auto& corners = geometry.triangles[t];
    const Eigen::Vector3f a = geometry.positions[corners[0]];
    const Eigen::Vector3f b = geometry.positions[corners[1]], c = geometry.positions[corners[2]];
    if (0.5f * (b - a).cross(c - a).norm() > kTerrain_m2) continue;
    const Eigen::Vector3f middle = (a + b + c) / 3.0f;
    squares_.insert(square(step(middle.x()), step(middle.y())));
  }
  Eigen::AlignedBox3f world;
  for (const scene::Chunk& chunk : geometry.chunks) world.extend(chunk.box);
  emptiest_m_ = emptiestOf(world.isEmpty() ? 0.0f : world.sizes().maxCoeff());
}

float Occupancy::coarsest_m(const Eigen::AlignedBox3f& box) const {
  constexpr float kNearThings_m = 16.0f;
  return anythingNear(box) ? kNearThings_m : emptiest_m_;
}

bool Occupancy::anythingNear(const Eigen::AlignedBox3f& box) const {
  constexpr int kMost = 32;  // squares an axis; larger cells are halved in any case
  const int left = step(box.min().x()) - 1, right = std::min(step(box.max().x()) + 1, left + kMost);
  const int low = step(box.min().y()) - 1, high = std::min(step(box.max().y()) + 1, low + kMost);
  for (int x = left; x <= right; ++x) {
    for (int y = low; y <= high; ++y) {
      if (squares_.count(square(x, y)) != 0) return true;
    }
  }
  return false;
}

}  // namespace sunlit::light
