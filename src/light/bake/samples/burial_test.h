/// Whether a point of the scene lies buried, where no camera looks, by the rays that leave it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "light/bake/samples/bake_rays.h"
#include "light/bake/samples/triangle_kinds.h"
#include "sunlit/light/geometry.h"

namespace sunlit::light {

/// A wall goes on below the ground, and ground below a kerb: nobody sees the light there, be it none or that
/// of the void under a sheet of ground, and what is seen of both must not take it by interpolation.
class BurialTest {
 public:
  /// A ray that left the point: the normal there, what it counts, and the lane of `hits` that tells what it
  /// met.
  struct Cast {
    const Eigen::Vector3f& normal;
    const Eigen::Vector3f& towards;
    float weight;
    const HitPacket& hits;
    int lane;
  };
  void add(const Cast& ray, const Geometry& geometry, const std::vector<TriangleTraits>& traits) {
    const std::uint32_t hit = ray.hits.triangle[ray.lane];
    if (hit == HitPacket::kNothing) return addFree(ray.weight, ray.towards.z() > 0.0f);
    const Eigen::Vector3f& met = geometry.planes[hit].normal;
    const Hit what{traits[hit], met.dot(ray.towards) > 0.0f, std::abs(met.dot(ray.normal)) > kParallel};
    addHit(ray.weight, what, ray.hits.distance[ray.lane]);
  }

  /// Within a body, or covered, or in the joint of two bodies; under a sheet of ground, or right under its
  /// edge, with the void below; among the backs of things, partly within a body or right behind a wall; or no
  /// sky and next to no front is seen, but that void, or a body from inside, or something close by.
  bool buried() const {
    if (inside_ >= 0.5f * all_ || touching_ > 0.9f * all_) return true;
    if (covered_ > 0.5f * all_ && up_ < 0.05f * all_) return true;
    if (touching_backs_ > 0.35f * all_ && up_ < 0.2f * all_) return true;
    if (touching_backs_ > 0.15f * all_ && down_ > 0.3f * all_) return true;
    const bool in_or_behind = inside_ > 0.1f * all_ || near_backs_ > 0.3f * all_;
    if (backs_ > 0.7f * all_ && up_ < 0.05f * all_ && in_or_behind) return true;
    if (backs_ > 0.5f * all_ && down_ > 0.1f * all_ && up_ < 0.1f * all_) return true;
    if (up_ > 0.03f * all_ || fronts_ > 0.1f * all_) return false;
    return down_ > 0.0f || inside_ > 0.2f * all_ || inverse_distances_ * kClose_m > all_;
  }

 private:
  void addFree(float weight, bool up) {
    all_ += weight;
    (up ? up_ : down_) += weight;
  }
  struct Hit {
    const TriangleTraits& triangle;
    bool back;
    bool parallel;  ///< to the surface that the point is on, about
  };
  void addHit(float weight, const Hit& hit, float distance_m) {
    all_ += weight;
    if (hit.back && hit.triangle.solid) inside_ += weight;
    if (!hit.back || isLeaf(hit.triangle.kind))
      fronts_ += weight;
    else
      backs_ += weight;
    if (distance_m < kTouching_m) {
      touching_ += weight;
      if (hit.back && !hit.triangle.solid) touching_backs_ += weight;
      if (hit.parallel) covered_ += weight;
    }
    if (hit.back && !hit.triangle.solid && !isLeaf(hit.triangle.kind) && distance_m < kClose_m)
      near_backs_ += weight;
    inverse_distances_ += weight / std::max(distance_m, kLeast_m);
  }

  static constexpr float kParallel = 0.7f;  ///< cosine between normals
  static constexpr float kTouching_m = 0.1f;
  static constexpr float kClose_m = 0.5f;
  static constexpr float kLeast_m = 1e-3f;
  float all_ = 0.0f, up_ = 0.0f, down_ = 0.0f;
  float inside_ = 0.0f, fronts_ = 0.0f, backs_ = 0.0f;
  float touching_ = 0.0f, touching_backs_ = 0.0f, near_backs_ = 0.0f, covered_ = 0.0f;
  float inverse_distances_ = 0.0f;
};

}  // namespace sunlit::light
