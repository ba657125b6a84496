/// Direct light of lamps, and of surfaces that pass it on, on what a camera sees.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "light/lamps/lamp_beam.h"
#include "light/picture/lamps/lit_rows.h"
#include "light/shading/glass_sheets.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"
#include "sunlit/scene/scene.h"

namespace sunlit::light {

/// Shadows are soft by the lamps' size. The more of a surface's light a lamp may give, the closer one looks:
/// for most lamps all surfaces cast one ray, for weaker ones every second of what fills pixels, and where
/// those near it within its tile find both light and shade, more; for the weakest every sixteenth pixel, of
/// which one takes the mean.
class LampLight {
 public:
  /// Lamps are left out of a surface that together would give a plane facing them at most this share of what
  /// it gets of other light and all lamps would give it, were nothing in their way.
  static constexpr float kLeftOut = 0.01f;

  struct Picture {
    const Surfaces& surfaces;
    const scene::Scene& scene;
    const Visibility& visibility;
    MirrorsByRays by_rays;  ///< which of the surfaces show by rays what they mirror
  };
  /// Keeps references to all of `picture`.
  LampLight(std::vector<LampBeam> beams, const Picture& picture);

  /// Adds what the lamps give to the luminance of each of the tile's surfaces, cd/m², without the air before
  /// it. `other_lx` is the illuminance of each by all other light: a hall's is no more than its windows let
  /// in.
  void addTo(const Tile& tile, const std::vector<float>& other_lx,
             std::vector<Eigen::Array3f>* luminances) const;

 private:
  /// How closely one looks for shadows, by the share that a lamp may have of the light that reaches a
  /// surface.
  enum class Closeness : std::uint8_t { kMean, kFew, kAll };
  static Closeness closenessOf(const LampBeam& beam, float share);
  /// Where a surface is seen.
  struct Place {
    std::uint8_t x, y;  ///< pixel in the tile
    bool fills;         ///< alone in its pixel
  };
  /// A surface that a lamp may light.
  struct Target {
    std::uint32_t surface;
    Eigen::Array3f unhidden;  ///< luminance by the lamp where nothing is in the way
    float brightest;          ///< its largest channel
    Place at;
    std::uint8_t lit = 0, cast = 0;  ///< rays
    Closeness closeness = Closeness::kAll;
    float seen = 1.0f;  ///< share of the lamp that is not hidden
  };

  std::vector<std::uint32_t> lampsOf(const Tile& tile, const std::vector<float>& other_lx) const;
  /// Of all surfaces.
  std::vector<Place> placesOf(const Tile& tile) const;
  /// Of those to which a lamp gives light.
  static std::vector<Target> targetsOf(const LitRows::Reflected& reflected, const LitRows& rows,
                                       const std::vector<Place>& places);
  /// Of lamps that matter, the brightest in the tile first: where they are hidden, the others are looked at
  /// more closely.
  struct OfLamp {
    std::uint32_t lamp;
    float sum;  ///< of all of its targets
    std::vector<Target> targets;
  };
  std::vector<OfLamp> targetsOf(const Tile& tile, const std::vector<float>& other_lx) const;
  void findShadows(std::uint32_t lamp, const Tile& tile, std::vector<Target>* targets) const;
  static void smoothPenumbrae(const Tile& tile, const std::vector<Target*>& targets);
  void cast(const LampBeam& beam, const Tile& tile, const std::vector<Target*>& targets) const;

  /// Share of a lamp's light that glass, and of one that casts shadows what blends, leave to a surface.
  Eigen::Array3f throughVeils(const LampBeam& beam, const Tile& tile, const Surface& surface) const;

  std::vector<LampBeam> beams_;
  Picture picture_;
  GlassSheets glass_;
};

}  // namespace sunlit::light
