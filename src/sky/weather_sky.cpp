#include "weather_sky.h"

#include <algorithm>
#include <cmath>

#include "sky_table.h"
#include "sunlit/quantity/range.h"

namespace sunlit::sky {
namespace {

/// Optical depth over which contrast falls to the 5 % of the meteorological optical range.
const double kRangeDepth = -std::log(0.05);

/// In whole millimetres, and of a wind that has blown for any time.
Eigen::Vector2d driftOf(const Weather& weather) {
  const double way_m = weather.wind_m_per_s * weather.clock_s;
  const auto along = [&](double part) { return std::nearbyint(1e3 * way_m * part) * 1e-3; };
  return {along(-sin(weather.wind_from)), along(-cos(weather.wind_from))};
}

const Eigen::Vector3f kOrigin = Eigen::Vector3f::Zero();

}  // namespace

double fogPerMetre(double visibility_m, double haze_per_m) {
  const double fog = kRangeDepth / visibility_m - haze_per_m;
  if (fog <= 0.0) {
    refuse("visibility", textOf(visibility_m) + " m",
           "less than the " + textOf(std::floor(kRangeDepth / haze_per_m)) +
               " m that the clear air of this turbidity has; or clear");
  }
  return fog;
}

WeatherSky::WeatherSky(const Weather& weather, const WeatherTables& tables, const SkyTable& clear)
    : rain_{weather.rain_mm_per_h, static_cast<std::uint64_t>(weather.seed), windNearGround(weather)} {
  std::optional<DropletLayer> fog;
  float below = tables.ground_albedo;
  if (weather.visibility_m || weather.rain_mm_per_h > 0.0) {
    const double of_rain = rainPerMetre(weather.rain_mm_per_h);
    const double of_fog = weather.visibility_m
                              ? fogPerMetre(*weather.visibility_m, static_cast<double>(tables.haze_per_m))
                              : 0.0;
    const double per_m = of_rain + of_fog;
    // One layer for both, so high that it takes from above what both do.
    const double top_m = (of_rain * weather.cloud_base_m + of_fog * weather.fog_top_m) / per_m;
    fog_per_m_ = static_cast<float>(per_m);
    fog_top_m_ = static_cast<float>(top_m);
    fog.emplace(tables.droplets, per_m * top_m);
    const float back = fog->sphericalAlbedo();
    below = back + (1.0F - back) * (1.0F - back) * below / (1.0F - below * back);
  }
  LightAbove above{{clear.sun, clear.moon},
                   [&](const Eigen::Vector3f& towards) { return clear.clearLuminance(towards); }};
  if (weather.cover_oktas > 0.0) cover(weather, {tables, clear, below}, &above);
  if (!fog) return;
  above.luminance = [&](const Eigen::Vector3f& towards) { return covered(clear, {towards, kOrigin, 0.0F}); };
  fog_.emplace(*fog, above, tables.ground_albedo);
}

void WeatherSky::cover(const Weather& weather, const Around& around, LightAbove* above) {
  const WeatherTables& tables = around.tables;
  if (weather.overcast == Overcast::kCie) {
    cie_.emplace(around.clear, tables.cie);
    above->discs.clear();
    return;
  }
  if (sky::isBroken(weather)) {
    broken_.emplace(CloudPlace{tables.clouds, weather.cloud_base_m, driftOf(weather)}, *above,
                    tables.droplets, around.albedo_below);
    broken_share_ =
        LinearRgb(broken_->level()).luminance() / std::max(LinearRgb(levelOf(*above)).luminance(), 1e-12F);
  } else {
    const DropletLayer cloud(tables.droplets, opticalDepthOf(weather));
    cover_.emplace(cloud, *above, around.albedo_below);
  }
  for (DiscLight& disc : above->discs)
    disc.illuminance = disc.illuminance * passed(static_cast<float>(disc.towards.vector().z()));
}

Eigen::Array3f WeatherSky::luminance(const SkyTable& clear, const Sight& sight) const {
  Eigen::Array3f light = covered(clear, sight);
  const float depth = depthAbove(sight);
  if (depth <= 0.0F) return light;
  // The part of the layer that is above the eye puts in as much of its light as it takes out of others.
  const float z = sight.towards.z(), source = stoppedOf(depth, z) / fog_->stopped(z);
  return fog_->scattered(sight.towards) * source + light * passedStraight(depth, z);
}

float WeatherSky::depthAbove(const Sight& sight) const {
  return fog_ ? fog_->depth() * std::max(1.0F - sight.height_m / fog_top_m_, 0.0F) : 0.0F;
}

Eigen::Array3f WeatherSky::covered(const SkyTable& clear, const Sight& sight) const {
  if (cie_) return cie_->luminance(sight.towards.z());
  if (broken_) return between(clear, sight);
  if (!cover_) return clear.clearLuminance(sight.towards);
  const float straight = cover_->passed(sight.towards.z());
  Eigen::Array3f light = cover_->scattered(sight.towards);
  if (straight > kNothing) light += clear.clearLuminance(sight.towards) * straight;
  return light;
}

Eigen::Array3f WeatherSky::between(const SkyTable& clear, const Sight& sight) const {
  const BrokenCover::Seen cloud = broken_->seen(sight.towards, sight.from);
  Eigen::Array3f light = clear.clearLuminance(sight.towards);
  if (cloud.passed >= 1.0F) return light;
  const AirColumn before = clear.clearAir(sight.towards, cloud.distance_m);
  light *= cloud.passed;
  return light + (1.0F - cloud.passed) * broken_share_ * before.airlight +
         cloud.scattered * before.transmittance;
}

float WeatherSky::passed(float z) const {
  const float passed = (fog_ ? fog_->passed(z) : 1.0F) * passedCover(z);
  return passed > kNothing ? passed : 0.0F;
}

float WeatherSky::passedCover(float z) const {
  if (cie_) return 0.0F;
  const float passed = cover_ ? cover_->passed(z) : broken_ ? broken_->meanPassed(z) : 1.0F;
  return passed > kNothing ? passed : 0.0F;
}

float WeatherSky::passedFog(const Sight& sight) const {
  const float passed = passedStraight(depthAbove(sight), sight.towards.z());
  return passed > kNothing ? passed : 0.0F;
}

float WeatherSky::passedThere(const Sight& sight) const {
  if (!broken_) return 1.0F;
  const float mean = broken_->meanPassed(sight.towards.z());
  return mean > 0.0F ? broken_->passed(sight.towards, sight.from) / mean : 1.0F;
}

AirColumn WeatherSky::airBelowCover(const SkyTable& clear, const Eigen::Vector3f& towards,
                                    float distance_m) const {
  AirColumn air = clear.clearAir(towards, distance_m);
  if (cie_) air.airlight = cie_->luminance(towards.z()) * (1.0F - air.transmittance);
  if (cover_) air.airlight = cover_->scattered(towards) * (1.0F - air.transmittance);
  if (broken_) air.airlight *= broken_share_;
  return air;
}

AirColumn WeatherSky::airOver(const SkyTable& clear, const Sight& sight, float distance_m) const {
  const Eigen::Vector3f& towards = sight.towards;
  AirColumn air = airBelowCover(clear, towards, distance_m);
  const Fog seen = fog(sight.height_m);
  const float way_m = seen.within(towards.z(), distance_m);
  if (!fog_ || way_m <= 0.0F) return air;
  const float straight = std::exp(-fog_per_m_ * way_m);
  // All the way up, fog puts in what it puts into the sky; of a part of the way, as much as that takes out.
  const float source = -std::expm1(-fog_per_m_ * way_m) / fog_->stopped(towards.z());
  AirColumn before{Eigen::Array3f::Ones(), Eigen::Array3f::Zero()};
  if (seen.begins(towards.z()) > 0.0F) before = airBelowCover(clear, towards, seen.begins(towards.z()));
  air.airlight = before.airlight + before.transmittance * fog_->scattered(towards) * source +
                 (air.airlight - before.airlight) * straight;
  air.transmittance *= straight;
  return air;
}

}  // namespace sunlit::sky
