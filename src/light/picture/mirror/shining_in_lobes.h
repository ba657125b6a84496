/// What rough mirrors show of surfaces that shine by themselves.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "light/geometry/ray_start.h"
#include "light/picture/mirror/lobe_rays.h"
#include "light/picture/mirror/reflections.h"
#include "light/picture/mirror/shining_list.h"
#include "light/shading/glass_sheets.h"
#include "light/shading/vertex.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {

/// Of one tile: by the rays of its lobes, and by as many points of what shines, each counted by how likely it
/// is beside the other (Veach & Guibas, "Optimally Combining Sampling Techniques for Monte Carlo Rendering",
/// 1995: the balance heuristic). Small panels are found by points, wide ones by rays.
class ShiningInLobes {
 public:
  struct Scene {
    const Visibility& visibility;
    const SceneVertices& vertices;
    const GlassSheets& glass;
    std::uint32_t width;  ///< of the picture, px
  };
  /// Keeps references to all.
  ShiningInLobes(const ShiningList& list, const Scene& scene, const Tile& tile,
                 const std::vector<Reflections::Mirroring>& mirrorings);

  /// One of a surface's rays: where the eye is, and where the ray goes, unit vectors.
  struct Ray {
    const Surface& surface;
    Eigen::Vector3f to_eye, towards;
  };
  /// Share of its own light that counts of what a ray met.
  float countedOf(const Ray& ray, const Hit& hit) const;

  /// Sets Mirroring::shining, by points. `toEye(surface, origin)` is the unit vector to who looks.
  template <typename ToEye>
  void add(std::vector<Reflections::Mirroring>* mirrorings, const ToEye& toEye);

 private:
  Eigen::Vector3f numbersOf(std::uint32_t pixel, std::uint32_t rays, std::uint32_t sample) const;
  void aim(const Reflections::Mirroring& mirroring, std::uint32_t number, std::uint32_t sample,
           const Eigen::Vector3f& to_eye);
  void cast(std::vector<Reflections::Mirroring>* mirrorings);

  Scene scene_;
  const Tile& tile_;
  ShiningList::Chances chances_;
  struct Sight {
    std::uint32_t number;  ///< of a mirroring
    Eigen::Vector3f start, way;
    Eigen::Array3f shining;  ///< what it adds to Mirroring::shining if nothing hides it
  };
  std::vector<Sight> sights_;
};

template <typename ToEye>
void ShiningInLobes::add(std::vector<Reflections::Mirroring>* mirrorings, const ToEye& toEye) {
  if (!chances_.any()) return;
  for (std::uint32_t number = 0; number < mirrorings->size(); ++number) {
    const Reflections::Mirroring& mirroring = (*mirrorings)[number];
    const Surface& surface = tile_.surfaces[mirroring.surface];
    if (!fillsLobe(surface)) continue;
    for (std::uint32_t k = 0; k < mirroring.rays; ++k)
      aim(mirroring, number, k, toEye(surface, rayStart(tile_, surface.first_sample + k)));
  }
  cast(mirrorings);
}

}  // namespace sunlit::light
