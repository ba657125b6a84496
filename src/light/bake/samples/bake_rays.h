/// What rays of the bake meet first.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "sunlit/light/geometry.h"

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

struct HitPacket {
  static constexpr std::uint32_t kNothing = 0xffffffffu;
  std::uint32_t triangle[RayPacket::kSize];        ///< index into Geometry::triangles, or kNothing
  float u[RayPacket::kSize], v[RayPacket::kSize];  ///< shares of the triangle's second and third corner
  float distance[RayPacket::kSize];                ///< in lengths of the direction
};

/// A look from one point at another.
struct BakeSight {
  Eigen::Vector3f origin;  ///< m in `map`
  Eigen::Vector3f way;     ///< to the other, m
  float reach;             ///< share of it that must be free
};

/// Surfaces stop light from both sides; masked ones let it through where they are cut out.
class BakeRays {
 public:
  /// Keeps `geometry` alive. Throws std::runtime_error if the ray library fails.
  explicit BakeRays(std::shared_ptr<const Geometry> geometry);
  ~BakeRays();
  BakeRays(const BakeRays&) = delete;
  BakeRays& operator=(const BakeRays&) = delete;

  void cast(const RayPacket& rays, HitPacket* hits) const;
  /// Sets hidden[i] to 1 where something stands in the way of sights[i], else to 0.
  void hide(const std::vector<BakeSight>& sights, std::vector<std::uint8_t>* hidden) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sunlit::light
