/// Rays of one fixed pattern around points of the scene, many points at a time.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "light/transport/bake_rays.h"
#include "light/transport/sky_patches.h"

namespace sunlit::light {

/// A point that gathers light, or some that do it together.
struct Site {
  static constexpr int kOrigins = 4;
  std::array<Eigen::Vector3f, kOrigins> origins;  ///< on the surface; rays take them in turn
  std::array<Eigen::Vector3f, kOrigins> lifts;    ///< from there to where rays of the lit side start
  Eigen::Vector3f normal;                         ///< unit
  float transmission = 0.0f;                      ///< share of its light that it takes from behind
  bool thin = false;                              ///< of a sheet: rays leave from either side of it
  bool coarse = false;                            ///< the coarse rays are enough: there are many like it

  /// Solid angle that a ray stands for; zero if it is not to be cast.
  float solidAngle(const SkyPatches::Ray& ray) const {
    if (!coarse) return ray.solid_angle;
    if (ray.coarse == SkyPatches::Ray::kFineOnly) return 0.0f;
    return ray.patch == SkyPatches::kBelow ? ray.solid_angle : SkyPatches::solidAngle(ray.patch);
  }
  /// What light from a direction counts, for a unit of solid angle; over the sphere it adds up to π.
  float weight(const Eigen::Vector3f& towards) const {
    const float cosine = normal.dot(towards);
    return cosine > 0.0f ? (1.0f - transmission) * cosine : -transmission * cosine;
  }
  Eigen::Vector3f start(std::size_t ray, const Eigen::Vector3f& towards) const {
    const Eigen::Vector3f& origin = origins[ray % kOrigins];
    const Eigen::Vector3f& lift = lifts[ray % kOrigins];
    return lift.dot(towards) > 0.0f || !thin ? Eigen::Vector3f(origin + lift)
                                             : Eigen::Vector3f(origin - lift);
  }
};

/// Casts each of `rays` that counts for a site, and calls visit(i, ray, weight, hits): the index of the site
/// (< 16), that of the ray, Site::weight() times the ray's solid angle, and the hits, of which lane i is the
/// site's. The sites of a call should be neighbours: their rays of one direction travel together.
template <typename Visit>
void probe(const BakeRays& scene, const std::vector<SkyPatches::Ray>& rays, const Site* sites, int count,
           const Visit& visit) {
  RayPacket packet;
  HitPacket hits;
  for (std::size_t r = 0; r < rays.size(); ++r) {
    const Eigen::Vector3f& towards = rays[r].towards;
    float weights[RayPacket::kSize];
    bool any = false;
    for (int i = 0; i < RayPacket::kSize; ++i) {
      weights[i] = i < count ? sites[i].weight(towards) * sites[i].solidAngle(rays[r]) : 0.0f;
      packet.valid[i] = weights[i] > 0.0f ? -1 : 0;
      any = any || weights[i] > 0.0f;
      const Eigen::Vector3f origin = sites[std::min(i, count - 1)].start(r, towards);
      packet.origin_x[i] = origin.x();
      packet.origin_y[i] = origin.y();
      packet.origin_z[i] = origin.z();
      packet.towards_x[i] = towards.x();
      packet.towards_y[i] = towards.y();
      packet.towards_z[i] = towards.z();
    }
    if (!any) continue;
    scene.cast(packet, &hits);
    for (int i = 0; i < count; ++i) {
      if (packet.valid[i]) visit(i, r, weights[i], hits);
    }
  }
}

}  // namespace sunlit::light
