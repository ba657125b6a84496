/// What stands between the clear sky and the ground: cloud and fog, in units.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sunlit/quantity/field.h"

namespace sunlit::sky {

/// How the light below a closed cover is found.
enum class Overcast {
  kLayer,  ///< an even layer of droplets of `optical_depth` under the clear sky of the hour
  kCie,  ///< CIE S 011/E:2003 type 1, of 300 + 21,000 sin h lx under a sun of elevation h (Radiance's gensky)
};

/// The default is no weather at all: the clear sky, to the bit.
struct Weather {
  double cover_oktas = 0.0;
  /// Of the cloud, vertical, the mean where there is some. Nothing: as opticalDepthOf() has it.
  std::optional<double> optical_depth;
  Overcast overcast = Overcast::kLayer;
  /// Meteorological optical range: a black board at this distance has a contrast of 5 % (CIE 17-28-020).
  /// Nothing: as far as the clear air lets one see.
  std::optional<double> visibility_m;
  double fog_top_m = 300.0;
  double rain_mm_per_h = 0.0;
  // Of a cover that is not closed:
  double cloud_base_m = 1500.0;
  double wind_m_per_s = 0.0;
  Angle wind_from = Angle::degrees(270.0);  ///< compass azimuth
  int seed = 0;
  /// How long the wind has blown since the cloud was where the seed has it, s. The same clock, the same
  /// cloud.
  double clock_s = 0.0;
};

inline std::vector<Field> fieldsOf(Weather& weather) {
  return {
      {"cover", &weather.cover_oktas, "oktas", {0, 8}, "of the sky by cloud: 0 clear, 8 closed"},
      {"optical_depth",
       NumberOrWord{&weather.optical_depth, "auto"},
       "",
       {0.1, 200},
       "of the cloud; auto: 30 closed, less broken. The sun is lost at 12 overhead"},
      {"overcast",
       choiceOf(&weather.overcast, {"layer", "cie"}),
       "",
       {},
       "a closed cover: layer (of droplets, of optical_depth) or cie (the standard overcast sky)"},
      {"visibility",
       NumberOrWord{&weather.visibility_m, "clear"},
       "m",
       {50, 100000},
       "meteorological optical range (contrast 5 %), less than the clear air's; clear: of the clear air"},
      {"fog_top", &weather.fog_top_m, "m", {10, 3000}, "height of the fog or haze above the ground's level"},
      {"rain",
       &weather.rain_mm_per_h,
       "mm/h",
       {0, 200},
       "that falls: 2.5 is light, 10 moderate, 50 heavy. It does not wet by itself: see wet"},
      {"cloud_base", &weather.cloud_base_m, "m", {100, 12000}, "height of broken cloud above the ground"},
      {"wind",
       &weather.wind_m_per_s,
       "m/s",
       {0, 100},
       "of the clouds: moves them and their shadows, and slants rain; 0: they stand"},
      {"wind_from", &weather.wind_from, "deg", {-360, 360}, "clockwise from north: 270 is a west wind"},
      {"cloud_seed", &weather.seed, "", {0, 2147483647}, "another seed, other clouds"}};
}

/// Throws std::invalid_argument naming key, value and what is allowed.
void validate(const Weather& weather);

/// Whether there is neither cloud, fog nor rain.
bool isClear(const Weather& weather);

/// The optical depth asked for, or 30 (cover / 8)^1.5: broken cloud is thinner, and so the mean illuminance
/// of a cover is what has been measured, 1 − 0.75 (cover / 8)^3.4 of the clear hour's (Kasten & Czeplak
/// 1980).
double opticalDepthOf(const Weather& weather);

/// What rain takes from a ray that a camera follows, 1/m: half of what its drops' shadows would by geometric
/// optics twice over, π N₀ / Λ³ of Marshall & Palmer's drops, 3.65e-4 R^0.63. The other half is diffracted by
/// less than 0.1°, and still seen.
double rainPerMetre(double rain_mm_per_h);

/// At a camera's height, 2 m, along x and y of `map`: wind (2 m / cloud_base)^(1/7), the power law of neutral
/// air over open land.
Eigen::Vector2d windNearGround(const Weather& weather);

/// Whether there is cloud with gaps in it.
bool isBroken(const Weather& weather);

/// Whether the light depends on the clock.
bool moves(const Weather& weather);

}  // namespace sunlit::sky
