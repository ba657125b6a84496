/// What cloud and fog make of a clear sky.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "cie_sky.h"
#include "droplets.h"
#include "layer_sky.h"
#include "sunlit/sky/daylight.h"
#include "sunlit/sky/weather.h"

namespace sunlit::sky {

struct SkyTable;

/// Where weather takes place.
struct WeatherGround {
  float albedo;
  float haze_per_m;  ///< extinction of the clear air there, by luminance
};

/// Cloud above all air that counts, and fog from the ground up, one after another: each throws light back at
/// what lies below it. Air between the eye and the cloud is as bright as the cloud behind it.
class WeatherSky {
 public:
  /// `clear`: sun, moon and sky as they would be without weather. Throws std::invalid_argument for a
  /// visibility that the clear air does not have.
  WeatherSky(const Weather& weather, const Droplets& droplets, const WeatherGround& ground,
             const SkyTable& clear, const CieLevels& cie);

  /// cd/m² of the sky above the horizon; of the horizon below it. `clear(towards)` is the sky without
  /// weather.
  template <typename Clear>
  Eigen::Array3f luminance(const Eigen::Vector3f& towards, const Clear& clear) const {
    Eigen::Array3f light = covered(towards, clear);
    if (fog_) light = fog_->scattered(towards) + light * fog_->passed(towards.z());
    return light;
  }
  /// What goes straight through at an elevation of sine `z`.
  float passed(float z) const;
  /// The air on the first `distance_m` of the way, `clear` without weather.
  AirColumn airOver(const AirColumn& clear, const Eigen::Vector3f& towards, float distance_m) const;

 private:
  /// Below the cloud, above the fog.
  template <typename Clear>
  Eigen::Array3f covered(const Eigen::Vector3f& towards, const Clear& clear) const {
    if (cie_) return cie_->luminance(towards.z());
    if (!cover_) return clear(towards);
    const float passed = cover_->passed(towards.z());
    Eigen::Array3f light = cover_->scattered(towards);
    if (passed > kNothing) light += clear(towards) * passed;
    return light;
  }
  bool isCovered() const { return cie_ || cover_; }

  static constexpr float kNothing = 1e-7F;

  std::optional<CieSky> cie_;
  std::optional<LayerSky> cover_, fog_;
  float fog_per_m_ = 0.0F, fog_top_m_ = 0.0F;
};

}  // namespace sunlit::sky
