/// Light that surfaces send towards whoever sees them: the camera, or a mirror.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "light/picture/ambient.h"
#include "light/picture/disc/disc_visibility.h"
#include "light/picture/glints.h"
#include "light/picture/lamps/lamp_light.h"
#include "light/picture/ready_picture.h"
#include "light/shading/glass_sheets.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {

class SurfaceLighting {
 public:
  /// What is lit, and what stands in the way.
  struct Subject {
    const ReadySurfaces& ready;
    const scene::Scene& scene;
    const Visibility& visibility;
    bool in_mirrors = false;  ///< lamps' own glass is left out: their highlights show them
  };
  /// Keeps references. Casts the rays to sun and moon, in parallel.
  SurfaceLighting(const Subject& subject, const Illumination& light);

  /// What one of a tile's surfaces mirrors, as rays met it.
  struct SeenByRays {
    std::uint32_t surface;     ///< index into Tile::surfaces
    float share;               ///< of its mirrored light, 0 … 1; the rest is that of its lobe
    Eigen::Array3f luminance;  ///< cd/m²
  };
  /// Luminance of each of Surfaces::tiles[tile].surfaces, cd/m², without the air before it. `by_rays` is in
  /// their order.
  void light(std::size_t tile, const std::vector<SeenByRays>& by_rays,
             std::vector<Eigen::Array3f>* luminances) const;

 private:
  /// What is known of a surface before it is lit.
  struct SurfaceParts {
    const AmbientReflectance& ambient;
    const AmbientLight& around;
    const Eigen::Array3f& discs;           ///< its luminance straight by sun and moon
    Eigen::Array3f sun_glint, moon_glint;  ///< by way of polished floors, lx on a plane facing them
    const SeenByRays* by_rays;             ///< null: none
  };
  /// But by lamps.
  Eigen::Array3f luminance(const Surface& surface, const SurfaceParts& parts) const;
  /// Share of a disc's light that one of a tile's surfaces gets.
  struct Disc {
    const DiscVisibility& visibility;
    const sky::DiscLight& light;
    const std::vector<float>& shares;  ///< of a tile's surfaces; empty: it gives too little
  };
  Eigen::Array3f ofDisc(const Disc& disc, const Tile& tile, std::size_t index) const;
  /// Share of the light from the disc's middle that veils let through.
  Eigen::Array3f throughVeils(const Disc& disc, const Tile& tile, const Surface& surface) const;
  /// The same where some of the disc is hidden, as its middle may be.
  Eigen::Array3f throughAtEdge(const Disc& disc, const Tile& tile, const Surface& surface) const;
  std::optional<Eigen::Array3f> throughAround(const Disc& disc, float reach, const Tile& tile,
                                              const Surface& surface) const;
  /// Of each of a tile's surfaces by sun and moon.
  struct ByDiscs {
    std::vector<Eigen::Array3f> luminances;
    std::vector<float> illuminances;  ///< lx, the largest channels
  };
  void addDisc(const Disc& disc, const Tile& tile, ByDiscs* by) const;

  const Surfaces& surfaces_;
  const Outlooks& outlooks_;
  const LightTable& table_;
  const scene::Scene& scene_;
  const Illumination& light_;
  std::vector<bool> glows_;  ///< of each material
  DiscVisibility sun_, moon_;
  std::unique_ptr<const Glints> sun_glints_, moon_glints_;  ///< null: none
  LampLight lamps_;
  const Visibility& visibility_;
  GlassSheets glass_;
  bool broken_cloud_;  ///< whether discs shine more on some places than on others
};

}  // namespace sunlit::light
