#include "weather_sky.h"

#include <algorithm>
#include <cmath>

#include "sky_table.h"
#include "sunlit/quantity/range.h"

namespace sunlit::sky {
namespace {

/// Optical depth over which contrast falls to the 5 % of the meteorological optical range.
const double kRangeDepth = -std::log(0.05);

/// Droplets in a metre of the fog, beside the clear air.
double fogPerMetre(double visibility_m, double haze_per_m) {
  const double fog = kRangeDepth / visibility_m - haze_per_m;
  if (fog <= 0.0) {
    refuse("visibility", textOf(visibility_m) + " m",
           "less than the " + textOf(std::floor(kRangeDepth / haze_per_m)) +
               " m that the clear air of this turbidity has; or clear");
  }
  return fog;
}

DiscLight dimmed(DiscLight disc, float passed) {
  disc.illuminance = disc.illuminance * passed;
  return disc;
}

}  // namespace

void validate(const Weather& weather) {
  requireFields(weather);
  if (weather.cover_oktas > 0.0 && weather.cover_oktas < 8.0)
    refuse("cover", textOf(weather.cover_oktas), "0 or 8");
  if (weather.overcast != Overcast::kCie) return;
  if (weather.cover_oktas < 8.0)
    refuse("cover", textOf(weather.cover_oktas), "8 where overcast is cie, which is a closed sky");
  if (weather.optical_depth)
    refuse("optical_depth", textOf(*weather.optical_depth), "auto where overcast is cie, which has none");
}

bool isClear(const Weather& weather) {
  return weather.cover_oktas <= 0.0 && !weather.visibility_m;
}

WeatherSky::WeatherSky(const Weather& weather, const Droplets& droplets, const WeatherGround& ground,
                       const SkyTable& clear, const CieLevels& cie) {
  std::optional<DropletLayer> fog;
  float below = ground.albedo;
  if (weather.visibility_m) {
    const double per_m = fogPerMetre(*weather.visibility_m, static_cast<double>(ground.haze_per_m));
    fog_per_m_ = static_cast<float>(per_m);
    fog_top_m_ = static_cast<float>(weather.fog_top_m);
    fog.emplace(droplets, per_m * weather.fog_top_m);
    const float back = fog->sphericalAlbedo();
    below = back + (1.0F - back) * (1.0F - back) * ground.albedo / (1.0F - ground.albedo * back);
  }
  const auto clearSky = [&](const Eigen::Vector3f& towards) { return clear.clearLuminance(towards); };
  LightAbove above{{clear.sun, clear.moon}, clearSky};
  if (weather.cover_oktas > 0.0) {
    if (weather.overcast == Overcast::kCie) {
      cie_.emplace(clear, cie);
      above.discs.clear();
    } else {
      const DropletLayer cloud(droplets, weather.optical_depth.value_or(Weather::kUsualOpticalDepth));
      cover_.emplace(cloud, above, below);
      for (DiscLight& disc : above.discs)
        disc = dimmed(disc, cloud.passed(static_cast<float>(disc.towards.vector().z())));
    }
  }
  if (!fog) return;
  above.luminance = [&](const Eigen::Vector3f& towards) { return covered(towards, clearSky); };
  fog_.emplace(*fog, above, ground.albedo);
}

float WeatherSky::passed(float z) const {
  if (cie_) return 0.0F;
  const float passed = (cover_ ? cover_->passed(z) : 1.0F) * (fog_ ? fog_->passed(z) : 1.0F);
  return passed > kNothing ? passed : 0.0F;
}

AirColumn WeatherSky::airOver(const AirColumn& clear, const Eigen::Vector3f& towards,
                              float distance_m) const {
  AirColumn air = clear;
  if (isCovered()) {
    const auto nothing = [](const Eigen::Vector3f&) { return Eigen::Array3f(Eigen::Array3f::Zero()); };
    air.airlight = covered(towards, nothing) * (1.0F - clear.transmittance);
  }
  if (!fog_) return air;
  const float way_m = towards.z() > 0.0F ? std::min(distance_m, fog_top_m_ / towards.z()) : distance_m;
  const float passed = std::exp(-fog_per_m_ * way_m);
  // All the way up, fog puts in what it puts into the sky; of a part of the way, as much as that takes out.
  const float source = (1.0F - passed) / (1.0F - fog_->passed(towards.z()));
  air.airlight = fog_->scattered(towards) * source + air.airlight * passed;
  air.transmittance *= passed;
  return air;
}

}  // namespace sunlit::sky
