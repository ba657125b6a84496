#include "light/picture/disc/floor_mirror.h"

#include <algorithm>
#include <vector>

#include "light/geometry/ray_list.h"
#include "light/shading/polished_floor.h"

namespace sunlit::light {

void FloorMirror::stopped(const Rays& rays, std::uint8_t* stopped) const {
  thread_local std::vector<Hit> hits;
  thread_local RayList up;
  thread_local std::vector<std::uint8_t> blocked;
  hits.resize(rays.count);
  visibility_.closest(rays, hits.data());
  up.clear();
  up.reserve(rays.count);
  for (std::uint32_t i = 0; i < rays.count; ++i) {
    stopped[i] = 1;
    if (hits[i].triangle == Hit::kMiss) continue;
    const Eigen::Vector3f down(rays.direction_x[i], rays.direction_y[i], rays.direction_z[i]);
    const Vertex floor = vertices_.at(hits[i], down.normalized());
    if (isPolishedFloor(floor)) up.add(i, floor.front, onDisc(mirrored(down)));
  }
  blocked.resize(up.size());
  visibility_.occluded(up.rays(), blocked.data());
  for (std::size_t k = 0; k < up.size(); ++k) stopped[up.number()[k]] = blocked[k];
}

/// The point of the disc in the direction that facets have spread: what they have turned they turn back.
Eigen::Vector3f FloorMirror::onDisc(const Eigen::Vector3f& spread) const {
  constexpr float kAboveHorizon = 1e-4f;
  Eigen::Vector3f aside = spread - towards_;
  const float far = aside.norm();
  if (far > tan_radius_) aside *= tan_radius_ / far;
  Eigen::Vector3f point = towards_ + aside;
  point.z() = std::max(point.z(), kAboveHorizon);
  return point;
}

std::optional<Vertex> FloorMirror::floorAlong(const Eigen::Vector3f& origin,
                                              const Eigen::Vector3f& down) const {
  const float *from = origin.data(), *towards = down.data();
  Hit hit;
  visibility_.closest({from, from + 1, from + 2, towards, towards + 1, towards + 2, 1}, &hit);
  if (hit.triangle == Hit::kMiss) return std::nullopt;
  const Vertex floor = vertices_.at(hit, down);
  return isPolishedFloor(floor) ? std::optional<Vertex>(floor) : std::nullopt;
}

}  // namespace sunlit::light
