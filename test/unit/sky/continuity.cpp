/// Light from one moment to the next.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/usual_air.h"

namespace sunlit::sky {
namespace {

constexpr double kTurn_deg_per_s = 360.0 / 86164.0;
constexpr double kStep_s = 10.0;

/// Where something of declination `declination_deg` stands `hour_angle_deg` after its culmination at 45°
/// north.
Direction standing(double hour_angle_deg, double declination_deg) {
  const double h = hour_angle_deg * kRadPerDeg;
  const double d = declination_deg * kRadPerDeg;
  const double root = std::sqrt(0.5);
  return Direction(Eigen::Vector3d(-std::cos(d) * std::sin(h),
                                   root * (std::sin(d) - std::cos(d) * std::cos(h)),
                                   root * (std::sin(d) + std::cos(d) * std::cos(h))));
}

/// Refraction of the directions seen, faded out over 5° below the horizon as those who call do it.
Direction raised(const Direction& towards) {
  const double deg = towards.elevation().deg();
  const double x = std::clamp((-0.6 - deg) / 5.0, 0.0, 1.0);
  const double at_deg = std::max(deg, -0.6);
  const double lift_deg = 1.02 / 60.0 / std::tan((at_deg + 10.3 / (at_deg + 5.11)) * kRadPerDeg);
  return Direction(towards.azimuth(), Angle::degrees(deg + lift_deg * (1.0 - x * x * (3.0 - 2.0 * x))));
}

/// The light `time_s` after noon of an equinox; a moon, if any, 10 days old.
Daylight lightAt(const Atmosphere& atmosphere, double time_s, bool with_moon, const Weather& weather = {}) {
  const double turned_deg = time_s * kTurn_deg_per_s;
  const Direction sun = standing(turned_deg, 0.0);
  NightSky night;
  if (with_moon) {
    const Direction moon = standing(turned_deg - 122.0, 12.0);
    night.moon = MoonInSky{raised(moon), moon, 384400e3, Angle::degrees(58.0)};
  }
  return atmosphere.daylight({raised(sun), 1.0, sun}, night, weather);
}

/// What pictures are made of. The discs' light comes as a part of what the ground gets, since a setting disc
/// goes out altogether.
std::vector<float> statistics(const Daylight& light) {
  std::vector<float> values;
  const auto add = [&](const Eigen::Array3f& rgb) {
    for (const float value : rgb) {
      values.push_back(value);
    }
  };
  add(light.skyLuminance({0.0F, 0.0F, 1.0F}).value);
  for (const double azimuth_deg : {90.0, 180.0, 270.0}) {
    const Direction low(Azimuth::degrees(azimuth_deg), Angle::degrees(2.0));
    values.push_back(light.skyLuminance(low.vector().cast<float>()).luminance());
    values.push_back(LinearRgb(light.airOver(low.vector().cast<float>(), 3000.0F).airlight).luminance());
  }
  const Eigen::Array3f ground = light.groundIlluminance().value;
  add(ground);
  add(ground + light.sun().illuminance.value);
  add(ground + light.moon().illuminance.value);
  return values;
}

TEST(Continuity, NothingJumpsInTenSecondsOfADayAndANight) {
  // In 10 s the sun goes 0.042° along and 0.030° down. Twilight falls by a factor of 3.4 a degree, 4 %; the
  // red horizon's parts and the setting disc fall up to twice as fast. A jump would stand out: of refraction,
  // of the disc's edge, or of a light that is left out when it is drowned.
  const Atmosphere& atmosphere = usualAir();
  for (const bool with_moon : {false, true}) {
    std::vector<double> times_s;
    for (double time_s = 0.0; time_s < 86164.0; time_s += 3000.0) {
      times_s.push_back(time_s);  // pairs over day and night
    }
    const double sunset_s = 90.0 / kTurn_deg_per_s;
    for (double time_s = sunset_s - 260.0; time_s < sunset_s + 300.0; time_s += kStep_s) {
      times_s.push_back(time_s);  // each of the sunset, through which the disc and the glow come and go
    }
    double known_s = -1.0;
    std::vector<float> before, after;  // the one of a step of the sunset is the other of the next
    for (const double time_s : times_s) {
      before = known_s == time_s ? after : statistics(lightAt(atmosphere, time_s, with_moon));
      known_s = time_s + kStep_s;
      after = statistics(lightAt(atmosphere, known_s, with_moon));
      for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_NEAR(after[i] / before[i], 1.0F, 0.08F)
            << "value " << i << " after " << time_s << " s" << (with_moon ? ", moon" : "");
      }
    }
  }
}

TEST(Continuity, NothingJumpsUnderTheStandardOvercast) {
  // Through sunset, with refraction: the sun's middle is seen on the horizon 0.57° before the sky takes it to
  // stand there.
  Weather grey;
  grey.cover_oktas = 8.0;
  grey.overcast = Overcast::kCie;
  const double sunset_s = 90.0 / kTurn_deg_per_s;
  const auto groundAt = [&](double time_s) {
    return lightAt(usualAir(), time_s, false, grey).groundIlluminance().luminance();
  };
  float before = groundAt(sunset_s - 200.0);
  for (double time_s = sunset_s - 200.0; time_s < sunset_s + 300.0; time_s += kStep_s) {
    const float after = groundAt(time_s + kStep_s);
    // As above; below the horizon by the clear sky's twilight.
    EXPECT_NEAR(after / before, 1.0F, 0.08F) << time_s - sunset_s;
    before = after;
  }
}

TEST(Continuity, WhatIsLeftOutByDayIsTooFaintToSee) {
  // The moon's sky is left out above 10° of sun, the night's glow above 0°, the sun's sky below −22°; each is
  // less than 1e-4 of what remains, far below a level of a picture (a 255th).
  const Atmosphere& atmosphere = usualAir();
  NightSky night;
  night.moon =
      MoonInSky{Direction(Azimuth::degrees(90.0), Angle::degrees(70.0)), std::nullopt, 384400e3, Angle()};
  const auto groundAt = [&](double elevation_deg) {
    const Direction sun(Azimuth::degrees(200.0), Angle::degrees(elevation_deg));
    return atmosphere.daylight({sun, 1.0}, night).groundIlluminance().luminance();
  };
  const double ten_deg = std::asin(0.17) / kRadPerDeg;
  const double lowest_deg = std::asin(-0.375) / kRadPerDeg;
  for (const double edge_deg : {ten_deg, 0.0, lowest_deg}) {
    EXPECT_NEAR(groundAt(edge_deg + 1e-5) / groundAt(edge_deg - 1e-5), 1.0F, 1e-4F) << edge_deg;
  }
}

}  // namespace
}  // namespace sunlit::sky
