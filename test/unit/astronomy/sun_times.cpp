#include "sunlit/astronomy/sun_times.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "sunlit/astronomy/refraction.h"
#include "sunlit/astronomy/sun_position.h"

namespace sunlit::astronomy {
namespace {

constexpr Air kAir{1013.25, 0.0, Angle::degrees(0.5667)};
const EarthRotation kEarth{0.0, 67.0};

double hours(int hour, int minute, double second) {
  return hour + minute / 60.0 + second / 3600.0;
}

Site siteAt(double latitude_deg, double longitude_deg, double elevation_m = 0.0) {
  return {Angle::degrees(latitude_deg), Angle::degrees(longitude_deg), elevation_m};
}

double elevationAt(const CivilDate& date, double hour, const Site& site) {
  return sunPosition(midnightOf(date).plusSeconds(hour * 3600.0), kEarth, site, kAir)
      .elevation_geometric.deg();
}

TEST(SunTimes, TheWorkedExamplesEveningIsNotThePrintedOne) {
  // Reda & Andreas print 17:20:19, the evening before: their A.2 works on the UT day.
  const Site golden = siteAt(39.742476, -105.1786, 1830.14);
  const SunTimes times = sunTimes({2003, 10, 17, -7.0}, golden, kAir, kEarth);
  ASSERT_TRUE(times.horizon.dusk);
  EXPECT_NEAR(*times.horizon.dusk, hours(17, 18, 50.5), 1.0 / 3600.0);
  const SunTimes eve = sunTimes({2003, 10, 16, -7.0}, golden, kAir, kEarth);
  EXPECT_NEAR(*eve.horizon.dusk, hours(17, 20, 19),
              2.0 / 3600.0);  // their interpolation is good to 1 s or so
  // Sunrise 6:12:43 and transit 11:46:05 are printed too, and of the right day.
  EXPECT_NEAR(*times.horizon.dawn, hours(6, 12, 43), 2.0 / 3600.0);
  EXPECT_NEAR(*times.transit, hours(11, 46, 5), 1.0 / 3600.0);
  EXPECT_EQ(times.state, SunState::kNormal);
}

TEST(SunTimes, TheEventsAreInOrderAndAtTheirElevations) {
  const CivilDate date{2024, 3, 20, 1.0};
  const Site site = siteAt(48.2, 16.4);
  const SunTimes times = sunTimes(date, site, kAir, kEarth);
  const double order[] = {*times.astronomical.dawn, *times.nautical.dawn, *times.civil.dawn,
                          *times.horizon.dawn,      *times.transit,       *times.horizon.dusk,
                          *times.civil.dusk,        *times.nautical.dusk, *times.astronomical.dusk};
  for (int i = 1; i < 9; ++i) EXPECT_LT(order[i - 1], order[i]);
  const double levels[] = {-18.0, -12.0, -6.0, -0.83337, 0.0, -0.83337, -6.0, -12.0, -18.0};
  for (int i = 0; i < 9; ++i) {
    if (i == 4) continue;
    // 1 ms of bisection, at no more than 15° an hour.
    EXPECT_NEAR(elevationAt(date, order[i], site), levels[i], 15.0 / 3600.0 * 1e-3);
  }
}

TEST(SunTimes, PolarNightHasNoSunriseButATwilight) {
  // SPA's A.2 invents both events here.
  const SunTimes times = sunTimes({2016, 11, 6, -6.0}, siteAt(74.6973, -94.8297), kAir, kEarth);
  EXPECT_EQ(times.state, SunState::kPolarNight);
  EXPECT_FALSE(times.horizon.dawn);
  EXPECT_FALSE(times.horizon.dusk);
  EXPECT_TRUE(times.transit);
  EXPECT_TRUE(times.civil.dawn);
  EXPECT_TRUE(times.civil.dusk);
}

TEST(SunTimes, PolarDayHasATransitOnly) {
  const SunTimes times = sunTimes({2024, 6, 21, 0.0}, siteAt(76.0, 20.0), kAir, kEarth);
  EXPECT_EQ(times.state, SunState::kPolarDay);
  EXPECT_FALSE(times.horizon.dawn || times.horizon.dusk || times.civil.dawn || times.civil.dusk ||
               times.nautical.dawn || times.nautical.dusk || times.astronomical.dawn ||
               times.astronomical.dusk);
  EXPECT_NEAR(*times.transit, 12.0 - 20.0 / 15.0 + 0.03, 0.01);
}

TEST(SunTimes, DeepPolarNightHasNoTwilightEither) {
  const SunTimes times = sunTimes({2024, 12, 21, 0.0}, siteAt(88.0, 0.0), kAir, kEarth);
  EXPECT_EQ(times.state, SunState::kPolarNight);
  EXPECT_FALSE(times.civil.dawn || times.nautical.dawn || times.astronomical.dawn);
}

TEST(SunTimes, AtThePoleTheSunRisesOnceAYear) {
  int sunrises = 0;
  for (int day = 10; day <= 25; ++day) {
    const SunTimes times = sunTimes({2024, 3, day, 0.0}, siteAt(90.0, 0.0), kAir, kEarth);
    sunrises += times.horizon.dawn ? 1 : 0;
    EXPECT_FALSE(times.horizon.dusk);
    if (day < 17) {
      EXPECT_EQ(times.state, SunState::kPolarNight);
    } else if (day > 20) {
      EXPECT_EQ(times.state, SunState::kPolarDay);
    }
  }
  EXPECT_EQ(sunrises, 1);
}

TEST(SunTimes, ASunThatShowsItselfForMinutesIsFound) {
  // Last days before the polar night at 76° N: each must agree with a scan by the second.
  for (int day = 30; day <= 37; ++day) {
    const CivilDate date = day <= 31 ? CivilDate{2024, 10, day, 1.0} : CivilDate{2024, 11, day - 31, 1.0};
    const Site site = siteAt(76.0, 15.0);
    const SunTimes times = sunTimes(date, site, kAir, kEarth);
    bool seen = false;
    for (double hour = 10.0; hour < 14.0; hour += 1.0 / 3600.0) {
      seen = seen || elevationAt(date, hour, site) > horizonElevation(kAir).deg();
    }
    EXPECT_EQ(times.horizon.dawn.has_value(), seen) << "day " << day;
    EXPECT_EQ(times.horizon.dusk.has_value(), seen) << "day " << day;
  }
}

TEST(SunTimes, WhereTheSunSetsAfterMidnightTheDuskComesFirst) {
  // Summer in Lapland on daylight saving time (+3 h): the sun sets 20 min past midnight.
  const SunTimes times = sunTimes({2024, 6, 9, 3.0}, siteAt(65.7, 25.0), kAir, kEarth);
  ASSERT_TRUE(times.horizon.dawn && times.horizon.dusk);
  EXPECT_LT(*times.horizon.dusk, *times.horizon.dawn);
  EXPECT_LT(*times.horizon.dawn, 4.0);
  EXPECT_EQ(times.state, SunState::kNormal);
}

/// First upward and last downward crossing by a scan of 10 s and a straight line between.
Crossings bruteForce(const std::vector<double>& curve, double level_deg) {
  Crossings found;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const double low = curve[i - 1] - level_deg;
    const double high = curve[i] - level_deg;
    if ((low > 0.0) == (high > 0.0)) continue;
    const double hour = (static_cast<double>(i) - 1.0 + low / (low - high)) * 10.0 / 3600.0;
    if (high > 0.0 && !found.dawn) found.dawn = hour;
    if (high <= 0.0) found.dusk = hour;
  }
  return found;
}

void expectSame(const std::optional<double>& ours, const std::optional<double>& scanned) {
  ASSERT_EQ(ours.has_value(), scanned.has_value());
  // The straight line over 10 s is good to 0.1 s, but for the flattest crossings of the polar regions: 1 s.
  EXPECT_NEAR(ours.value_or(0.0), scanned.value_or(0.0), 1.0 / 3600.0);
}

TEST(SunTimes, AgreeWithBruteForceAtRandomPlaces) {
  std::mt19937_64 random(5);
  std::uniform_int_distribution<int> year(-1000, 5000), month(1, 12), day(1, 28), zone(-12, 12);
  std::uniform_real_distribution<double> latitude(-90.0, 90.0), longitude(-180.0, 180.0);
  for (int i = 0; i < 60; ++i) {
    const CivilDate date{year(random), month(random), day(random), static_cast<double>(zone(random))};
    // Every other place beyond 60°, where events are few, flat and short.
    const double anywhere = latitude(random);
    const Site site = siteAt(i % 2 == 0 ? anywhere : std::copysign(60.0 + std::abs(anywhere) / 3.0, anywhere),
                             longitude(random));
    std::vector<double> curve;
    for (int step = 0; step <= 8640; ++step) curve.push_back(elevationAt(date, step * 10.0 / 3600.0, site));
    const SunTimes times = sunTimes(date, site, kAir, kEarth);
    const Crossings ours[] = {times.horizon, times.civil, times.nautical, times.astronomical};
    const double levels[] = {horizonElevation(kAir).deg(), -6.0, -12.0, -18.0};
    for (int j = 0; j < 4; ++j) {
      SCOPED_TRACE("latitude " + std::to_string(site.latitude.deg()) + ", level " +
                   std::to_string(levels[j]));
      const Crossings expected = bruteForce(curve, levels[j]);
      expectSame(ours[j].dawn, expected.dawn);
      expectSame(ours[j].dusk, expected.dusk);
    }
  }
}

TEST(SunTimes, RefuseABadDate) {
  EXPECT_THROW(sunTimes({2023, 2, 29, 0.0}, Site{}, kAir, kEarth), std::invalid_argument);
}

}  // namespace
}  // namespace sunlit::astronomy
