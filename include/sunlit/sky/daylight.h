/// The light that arrives at the scene from outside it: sun disc and sky.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/direction.h"
#include "sunlit/quantity/photometry.h"
#include "sunlit/sky/fog.h"
#include "sunlit/sky/night.h"

namespace sunlit::sky {

/// Angular radius of the sun seen from 1 AU: 959.63″ (Astronomical Almanac).
constexpr Angle kSunRadiusAtOneAu = Angle::degrees(0.2666);
inline Angle sunAngularRadius(double distance_au) {
  return Angle::radians(std::asin(sin(kSunRadiusAtOneAu) / distance_au));
}

/// What stands before a distant light: the moon before the sun.
struct DiscCover {
  Direction towards;  ///< its centre
  Angle angular_radius;
};

/// A distant light of visible size, such as the sun.
struct DiscLight {
  Direction towards;                         ///< apparent centre, may lie below the horizon
  Angle angular_radius = kSunRadiusAtOneAu;  ///< true angular radius of the disc
  LinearRgb illuminance;  ///< lx on a plane facing it, at the ground, if nothing in the scene obscures it;
                          ///< zero when the whole disc is set or covered
  /// What lights the disc itself: for the moon the direction of the sun as seen from it, of which it shows
  /// the phase. Empty for the sun, which shines all over.
  std::optional<Direction> lit_from = std::nullopt;
  std::optional<DiscCover> cover = std::nullopt;  ///< that hides some of it, which `illuminance` lacks
};

/// What the air between the eye and a surface does to the surface's luminance L: L · transmittance +
/// airlight.
struct AirColumn {
  Eigen::Array3f transmittance;  ///< 0 … 1
  Eigen::Array3f airlight;       ///< cd/m²
};

/// Rain that falls through the air.
struct Rain {
  double mm_per_h = 0.0;
  std::uint64_t seed = 0;                              ///< of its drops
  Eigen::Vector2d wind_m_s = Eigen::Vector2d::Zero();  ///< x and y in `map`, that carries them
};

/// Tabulated sky; see atmosphere.h for how it is computed.
struct SkyTable;

/// Light of one instant at one place. Cheap to copy, immutable, safe to read from many threads.
/// Direction arguments are unit vectors in `map` (ENU).
class Daylight {
 public:
  explicit Daylight(std::shared_ptr<const SkyTable> table);

  /// The same light, but that clouds and fog are seen from a place in `map`; else they are seen from the
  /// ground's level at x = y = 0. Of fog an eye has above it what lies between its height and the layer's
  /// top, or looks down on it; below the ground's level it has all, as on the ground.
  Daylight seenFrom(const Eigen::Vector3f& place) const;
  /// The same light over ground at this height in `map`, from which fog reaches up and above which the base
  /// of broken cloud lies; else it is at 0. Before seenFrom().
  Daylight overGround(float level_m) const;
  /// The same light, but that no air lies between the eye and what it sees: for views from far above.
  Daylight withoutAir() const;
  /// Whether there is cloud with gaps in it, so that sun and moon do not shine alike everywhere.
  bool hasBrokenCloud() const;
  /// By how much sun or moon are brighter at a place, under gaps and clouds, than DiscLight::illuminance,
  /// which is the mean over all places; 1 without broken cloud.
  float throughCloud(const DiscLight& disc, const Eigen::Vector3f& place) const;

  /// Luminance of the sky behind the scene by sun, moon and night glow, cd/m², without the discs and stars.
  /// Below the horizon: the luminance of the ground far away, continuous at the horizon.
  LinearRgb skyLuminance(const Eigen::Vector3f& towards) const;
  /// The same, seen from a place in `map`.
  LinearRgb skyLuminance(const Eigen::Vector3f& towards, const Eigen::Vector3f& place) const;
  /// Illuminance, lx, of an unoccluded surface facing `normal`: from the sky above the horizon and from
  /// ground of the model's albedo below it; without the discs' direct light.
  LinearRgb skyIlluminance(const Eigen::Vector3f& normal) const;
  const DiscLight& sun() const;
  /// Without illuminance where there is no moon, or it is set or new.
  const DiscLight& moon() const;
  /// As they shine on the place that they are seen from: through clouds and gaps, and the fog above it.
  DiscLight sunSeen() const;
  DiscLight moonSeen() const;
  LinearRgb starSeen(const PointLight& star) const;
  /// Stars above the horizon, brightest first, as they shine above any fog; their light is not in
  /// skyLuminance().
  const std::vector<PointLight>& stars() const;
  /// The air on the first `distance_m` ≥ 0 metres of the way `towards`, seen from the observer: within 4 % of
  /// small steps through the same air; far away at the horizon it becomes skyLuminance(). No surface shades
  /// it. Below the observer's sea level the air goes on as there. Fog below the eye is as bright as fog at
  /// the horizon. A table look-up of some 40 ns.
  AirColumn airOver(const Eigen::Vector3f& towards, float distance_m) const;
  /// Illuminance of level, open ground: sun, moon and sky together, lx.
  LinearRgb groundIlluminance() const;
  Rain rain() const;
  /// That airOver() has in it; none of withoutAir().
  Fog fog() const;

 private:
  /// x and y in `map`, z above the ground's level.
  Eigen::Vector3f aboveGround(const Eigen::Vector3f& place) const;
  /// Of light from above the fog.
  float passedHere(const Eigen::Vector3f& towards) const;

  std::shared_ptr<const SkyTable> table_;
  Eigen::Vector3f from_ = Eigen::Vector3f::Zero();  ///< as aboveGround() has places
  float ground_m_ = 0.0F;                           ///< z in `map`
  bool has_air_ = true;
};

}  // namespace sunlit::sky
