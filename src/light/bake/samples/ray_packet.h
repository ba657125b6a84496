/// Rays that leave together, and what they meet.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "sunlit/light/visibility.h"

namespace sunlit::light {

/// Rays that leave together: alike in direction, or in place.
struct RayPacket {
  static constexpr int kSize = 16;
  alignas(64) float origin_x[kSize], origin_y[kSize], origin_z[kSize];  ///< m in `map`
  alignas(64) float towards_x[kSize], towards_y[kSize], towards_z[kSize];
  alignas(64) int valid[kSize];  ///< −1: cast it; 0: leave it out

  void set(std::size_t lane, const Eigen::Vector3f& origin, const Eigen::Vector3f& towards, bool cast) {
    origin_x[lane] = origin.x(), origin_y[lane] = origin.y(), origin_z[lane] = origin.z();
    towards_x[lane] = towards.x(), towards_y[lane] = towards.y(), towards_z[lane] = towards.z();
    valid[lane] = cast ? -1 : 0;
  }
};
/// Faces so near to one another are at one place.
constexpr float kSamePlace_m = 1e-3f;
/// The same along a ray at this distance, with what rounding makes of it; both in lengths of its direction.
inline float samePlace(const RayPacket& rays, int lane, float distance) {
  const Eigen::Vector3f towards(rays.towards_x[lane], rays.towards_y[lane], rays.towards_z[lane]);
  return kSamePlace_m / towards.norm() + 1e-5f * distance;
}
/// Its size as a count of what is taken a packet at a time.
constexpr std::size_t kPacket = RayPacket::kSize;

struct HitPacket {
  static constexpr std::uint32_t kNothing = 0xffffffffu;
  std::uint32_t triangle[RayPacket::kSize];        ///< index into Geometry::triangles, or kNothing
  float u[RayPacket::kSize], v[RayPacket::kSize];  ///< shares of the triangle's second and third corner
  float distance[RayPacket::kSize];                ///< in lengths of the direction

  void set(int lane, const Hit& hit) {
    triangle[lane] = hit.triangle;
    u[lane] = hit.u, v[lane] = hit.v;
    distance[lane] = hit.distance;
  }
};

/// How far along their directions rays are looked at, in lengths of these.
struct RayReach {
  alignas(64) float from[RayPacket::kSize];
  alignas(64) float to[RayPacket::kSize];

  /// All the way.
  RayReach() {
    std::fill_n(from, RayPacket::kSize, 0.0f);
    std::fill_n(to, RayPacket::kSize, std::numeric_limits<float>::infinity());
  }
};

}  // namespace sunlit::light
