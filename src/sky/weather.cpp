#include "sunlit/sky/weather.h"

#include <cmath>
#include <string>

#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/raindrops.h"
#include "sunlit/quantity/range.h"

namespace sunlit::sky {

namespace {

/// Not so little that single precision loses it.
void requireNoneOrAtLeast(const char* key, double value, double least, const std::string& most) {
  if (value > 0.0 && value < least) refuse(key, textOf(value), "0 or from " + textOf(least) + " to " + most);
}

}  // namespace

void validate(const Weather& weather) {
  requireFields(weather);
  requireNoneOrAtLeast("cover", weather.cover_oktas, 0.01, "8 oktas");
  requireNoneOrAtLeast("rain", weather.rain_mm_per_h, 0.001, "200 mm/h");
  if (weather.overcast != Overcast::kCie) return;
  if (weather.cover_oktas < 8.0)
    refuse("cover", textOf(weather.cover_oktas), "8 where overcast is cie, which is a closed sky");
  if (weather.optical_depth)
    refuse("optical_depth", textOf(*weather.optical_depth), "auto where overcast is cie, which has none");
}

bool isClear(const Weather& weather) {
  return weather.cover_oktas <= 0.0 && !weather.visibility_m && weather.rain_mm_per_h <= 0.0;
}

double opticalDepthOf(const Weather& weather) {
  return weather.optical_depth.value_or(30.0 * std::pow(weather.cover_oktas / 8.0, 1.5));
}

double rainPerMetre(double rain_mm_per_h) {
  const double shadows_mm2 = kPi * kRaindropsAtZero / (2.0 * std::pow(raindropSlope(rain_mm_per_h), 3));
  return 1e-6 * shadows_mm2;  // in a m³
}

Eigen::Vector2d windNearGround(const Weather& weather) {
  constexpr double kHeight_m = 2.0, kExponent = 1.0 / 7.0;
  const double speed = weather.wind_m_per_s * std::pow(kHeight_m / weather.cloud_base_m, kExponent);
  return {-speed * sin(weather.wind_from), -speed * cos(weather.wind_from)};
}

bool isBroken(const Weather& weather) {
  return weather.cover_oktas > 0.0 && weather.cover_oktas < 8.0;
}

bool moves(const Weather& weather) {
  return isBroken(weather) && weather.wind_m_per_s > 0.0;
}

}  // namespace sunlit::sky
