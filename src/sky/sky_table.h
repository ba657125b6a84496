/// The sky of one instant, tabulated.
#pragma once

#include <Eigen/Core>
#include <Eigen/StdVector>
#include <memory>
#include <optional>
#include <vector>

#include "air_table.h"
#include "night_glow.h"
#include "scattered_sky.h"
#include "sunlit/sky/daylight.h"
#include "weather_sky.h"

namespace sunlit::sky {

/// All light of the sky above, and what follows from it. What adds nothing visible is empty.
struct SkyTable {
  static constexpr int kNormals = 21;  // a side of the octahedral map

  std::optional<ScatteredSky> sun_sky, moon_sky;
  std::optional<GlowSky> glow;
  std::shared_ptr<const AirSights> sights;
  std::optional<LitAir> sun_air, moon_air;
  Eigen::Array3f even = Eigen::Array3f::Zero();  // cd/m², the same from everywhere above
  DiscLight sun;
  DiscLight moon;
  LinearRgb sun_above_fog, moon_above_fog;    // illuminance in weather
  std::shared_ptr<const WeatherSky> weather;  // null: clear
  std::vector<PointLight> stars;              // above the fog
  std::vector<Eigen::Array4f, Eigen::aligned_allocator<Eigen::Array4f>>
      illuminance;                                             // lx, by normal, in `map`
  Eigen::Array3f ground_luminance = Eigen::Array3f::Zero();    // cd/m²
  Eigen::Array3f ground_illuminance = Eigen::Array3f::Zero();  // lx
  Eigen::Array3f haze_per_km = Eigen::Array3f::Zero();         // extinction near the ground

  /// Of the sky without weather; below the horizon, of the horizon.
  Eigen::Array3f clearLuminance(const Eigen::Vector3f& towards) const;
  /// Of the sky; below the horizon, of the horizon.
  Eigen::Array3f skyLuminance(const Sight& sight) const;
  Eigen::Array3f luminance(const Sight& sight) const;
  Eigen::Array3f illuminanceOn(const Eigen::Vector3f& normal) const;
  AirColumn airOver(const Sight& sight, float distance_m) const;
  /// Without weather.
  AirColumn clearAir(const Eigen::Vector3f& towards, float distance_m) const;
};

/// Fills the parts of `table` that follow from its sky and discs.
void gatherIlluminance(float ground_albedo, SkyTable* table);

}  // namespace sunlit::sky
