/// Direct light of lamps on what a camera sees.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "light/lamps/lamp_beam.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"
#include "sunlit/scene/scene.h"

namespace sunlit::light {

/// Shadows are soft by the lamps' size: two rays a surface and lamp, and where surfaces near it within its
/// tile find both light and shade, as many as a lamp has points.
class LampLight {
 public:
  /// Lamps are left out of a surface that together would give a plane facing them at most this share of what
  /// all lamps and the sky would give it, were nothing in the way.
  static constexpr float kLeftOut = 0.01f;

  struct Picture {
    const Surfaces& surfaces;
    const scene::Scene& scene;
    const Visibility& visibility;
  };
  /// Keeps references to all of `picture`. `day_lx`: illuminance of level, open ground without lamps.
  LampLight(const std::vector<scene::Lamp>& lamps, float day_lx, const Picture& picture);

  /// Luminance of each of the tile's surfaces by the lamps, cd/m², without the air before it; empty where no
  /// lamp matters.
  void light(const Tile& tile, std::vector<Eigen::Array3f>* luminances) const;

 private:
  /// A surface that a lamp may light.
  struct Target {
    std::uint32_t surface;
    Eigen::Array3f unhidden;  ///< luminance by the lamp where nothing is in the way
    std::uint8_t x, y;        ///< pixel in the tile
    std::uint8_t lit, cast;   ///< rays
  };

  std::vector<std::uint32_t> lampsOf(const Tile& tile) const;
  std::vector<Target> targetsOf(const LampBeam& beam, const Tile& tile,
                                const std::vector<float>& least_lx) const;
  void findShadows(const LampBeam& beam, const Tile& tile, std::vector<Target>* targets) const;
  void cast(const LampBeam& beam, const Tile& tile, const std::vector<Target*>& targets, int up_to) const;

  std::vector<LampBeam> beams_;
  float day_lx_;
  Picture picture_;
};

}  // namespace sunlit::light
