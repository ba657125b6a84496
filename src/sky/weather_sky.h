/// What cloud and fog make of a clear sky.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "broken_cover.h"
#include "cie_sky.h"
#include "droplets.h"
#include "layer_sky.h"
#include "sunlit/sky/daylight.h"
#include "sunlit/sky/weather.h"

namespace sunlit::sky {

struct SkyTable;

/// What is made beforehand, and where weather takes place.
struct WeatherTables {
  const Droplets& droplets;
  std::shared_ptr<const CloudMap> clouds;  ///< of a broken cover; else null
  CieLevels cie;
  float ground_albedo;
  float haze_per_m;  ///< extinction of the clear air near the ground, by luminance
};

/// Extinction of the fog of a meteorological optical range, 1/m, beside that of the clear air. Throws
/// std::invalid_argument where that alone lets one see no farther.
double fogPerMetre(double visibility_m, double haze_per_m);

/// A line of sight towards a unit vector.
struct Sight {
  const Eigen::Vector3f& towards;
  const Eigen::Vector3f& from;  ///< x and y in `map`, z above the ground's level: clouds lie over it
  float height_m;               ///< above the ground that fog lies on, ≥ 0
};

/// Cloud above all air that counts, and fog from the ground up, one after another: each throws light back at
/// what lies below it. Air between the eye and a closed cover is as bright as the cloud behind it; before
/// broken cloud it is as bright as clear air, by what of all light comes through.
class WeatherSky {
 public:
  /// `clear`: sun, moon and sky as they would be without weather. Throws std::invalid_argument for a
  /// visibility that the clear air does not have.
  WeatherSky(const Weather& weather, const WeatherTables& tables, const SkyTable& clear);

  /// cd/m² of the sky above the horizon; of the horizon below it.
  Eigen::Array3f luminance(const SkyTable& clear, const Sight& sight) const;
  /// What goes straight through to the ground at an elevation of sine `z`; of broken cloud the mean over all
  /// places.
  float passed(float z) const;
  /// The same to the top of the fog.
  float passedCover(float z) const;
  /// What the fog above the eye lets through.
  float passedFog(const Sight& sight) const;
  /// Whether it differs from place to place.
  bool isBroken() const { return broken_.has_value(); }
  /// How much more than that comes through to a place from a disc that stands `towards`.
  float passedThere(const Sight& sight) const;
  const Rain& rain() const { return rain_; }
  /// For an eye so high above the ground.
  Fog fog(float height_m) const { return {fog_per_m_, fog_top_m_ - height_m}; }
  /// The air on the first `distance_m` of the way; what it is without weather, `clear` knows.
  AirColumn airOver(const SkyTable& clear, const Sight& sight, float distance_m) const;

 private:
  /// Below the cloud, above the fog.
  Eigen::Array3f covered(const SkyTable& clear, const Sight& sight) const;
  Eigen::Array3f between(const SkyTable& clear, const Sight& sight) const;
  /// Without fog.
  AirColumn airBelowCover(const SkyTable& clear, const Eigen::Vector3f& towards, float distance_m) const;
  /// Optical depth of what of the fog lies above the eye.
  float depthAbove(const Sight& sight) const;
  struct Around {
    const WeatherTables& tables;
    const SkyTable& clear;
    float albedo_below;
  };
  /// Puts the cover between `above` and what lies below.
  void cover(const Weather& weather, const Around& around, LightAbove* above);

  static constexpr float kNothing = 1e-7F;

  Rain rain_;
  std::optional<CieSky> cie_;
  std::optional<LayerSky> cover_, fog_;
  std::optional<BrokenCover> broken_;
  float broken_share_ = 1.0F;  ///< of the clear hour's light that comes through, the mean
  float fog_per_m_ = 0.0F, fog_top_m_ = 0.0F;
};

}  // namespace sunlit::sky
