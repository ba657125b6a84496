/// What bodies hide of the light from all around.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "light/picture/outlook/outlook.h"
#include "sunlit/light/bodies.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {

class BodyShade {
 public:
  /// `placed`: the bodies where they stand, as `visibility` has them beside the scene. Keeps references.
  BodyShade(const Bodies& bodies, const Geometry& placed, const Visibility& visibility);

  /// Sets Outlook::body and Outlook::unhidden.
  void apply(const Tile& tile, TileOutlooks* outlooks) const;

 private:
  struct RayList;
  struct Sphere {
    Eigen::Vector3f centre;
    float radius_m;
    float shown_m2;  ///< mean area that the body in it shows to a far observer, at most the sphere's
  };
  /// 0 where the bodies are too far or behind, 1 where they may hide a considerable share.
  float nearness(const Surface& surface) const;
  void appendRays(const Tile& tile, std::uint32_t index, bool first, RayList* rays) const;
  void cast(const RayList& rays, std::vector<float>* hidden) const;

  const Bodies& bodies_;
  const Visibility& visibility_;
  std::uint32_t first_triangle_;                      ///< of the bodies
  Eigen::Vector3f centre_ = Eigen::Vector3f::Zero();  ///< of a sphere around all of them
  float radius_m_ = 0.0f;
  std::vector<Sphere> spheres_;  ///< of each body
};

}  // namespace sunlit::light
