/// Kinds of weather that tests look at.
#pragma once

#include <optional>

#include "directions.h"

namespace sunlit::sky {

inline Direction sunAt(double elevation_deg, double azimuth_deg = 137.0) {
  return at(azimuth_deg, elevation_deg);
}

inline Eigen::Vector3f towards(double elevation_deg, double azimuth_deg = 137.0) {
  return sunAt(elevation_deg, azimuth_deg).vector().cast<float>();
}

inline Daylight under(double sun_deg, const Weather& weather) {
  return usualAir().daylight({sunAt(sun_deg), 1.0}, {}, weather);
}

inline Weather covered(double oktas, std::optional<double> optical_depth = std::nullopt) {
  Weather weather;
  weather.cover_oktas = oktas;
  weather.optical_depth = optical_depth;
  return weather;
}

inline Weather standardOvercast() {
  Weather weather = covered(8.0);
  weather.overcast = Overcast::kCie;
  return weather;
}

inline Weather fog(double visibility_m) {
  Weather weather;
  weather.visibility_m = visibility_m;
  return weather;
}

inline double levelOf(const Daylight& day) {
  return static_cast<double>(day.groundIlluminance().luminance());
}

}  // namespace sunlit::sky
