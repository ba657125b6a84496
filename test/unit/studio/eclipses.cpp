// Eclipses when and where they were seen. Times and shares are those of NASA's tables and maps (F. Espenak,
// eclipse.gsfc.nasa.gov).
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "sunlit/astronomy/civil_time.h"
#include "sunlit/quantity/moon.h"
#include "sunlit/sky/eclipse.h"
#include "sunlit/studio/sky.h"
#include "support/usual_air.h"

namespace sunlit::studio {
namespace {

const Site kDallas{Angle::degrees(32.78), Angle::degrees(-96.80), 130.0};
const Site kNewYork{Angle::degrees(40.71), Angle::degrees(-74.01), 10.0};
const Site kAlbuquerque{Angle::degrees(35.08), Angle::degrees(-106.65), 1600.0};
const Site kSydney{Angle::degrees(-33.87), Angle::degrees(151.21), 0.0};

/// UTC.
struct Day {
  int year, month, day;
};
constexpr Day kTotal{2024, 4, 8}, kAnnular{2023, 10, 14}, kLunar{2025, 3, 14};

SkyBodies bodiesOn(const Day& day, const Site& site, double second) {
  const Instant midnight = astronomy::midnightOf({day.year, day.month, day.day, 0.0});
  return bodiesAt(midnight.plusSeconds(second), site);
}

double coveredSun(const Day& day, const Site& site, double second) {
  const SkyBodies bodies = bodiesOn(day, site, second);
  return 1.0 - sky::uncoveredArea(sky::sunBehindMoon(bodies.sun, *bodies.moon));
}

double sunlightOnMoon(const Day& day, const Site& site, double second) {
  const SkyBodies bodies = bodiesOn(day, site, second);
  return sky::sunlightOnMoon(bodies.sun, *bodies.moon);
}

double clock(int hour, int minute, int second = 0) {
  return 3600.0 * hour + 60.0 * minute + second;
}

/// Seconds of the day from `begin` on in which something is so, looked for every second one.
struct Span {
  double first = 0.0, last = 0.0;
};
Span spanOf(double begin, double end, const std::function<bool(double)>& is) {
  std::optional<Span> span;
  for (double second = begin; second <= end; second += 2.0) {
    if (!is(second)) continue;
    if (!span) span = Span{second, second};
    span->last = second;
  }
  return span.value_or(Span());
}

double greatest(double begin, double end, const std::function<double(double)>& value) {
  double best = begin;
  for (double second = begin; second <= end; second += 1.0)
    if (value(second) > value(best)) best = second;
  return best;
}

/// 3″ of the moon (rms), of which it covers 0.4″ a second, another 2.5″ for ΔT, and mountains at its rim.
constexpr double kContact_s = 20.0;

TEST(SolarEclipse, IsTotalAtDallas) {
  const Span total = spanOf(clock(18, 35), clock(18, 50),
                            [](double second) { return coveredSun(kTotal, kDallas, second) == 1.0; });
  EXPECT_NEAR(total.first, clock(18, 40, 43), kContact_s);
  EXPECT_NEAR(total.last, clock(18, 44, 34), kContact_s);
  const Span partial = spanOf(clock(17, 15), clock(20, 10),
                              [](double second) { return coveredSun(kTotal, kDallas, second) > 0.0; });
  EXPECT_NEAR(partial.first, clock(17, 23, 18), kContact_s);
  EXPECT_NEAR(partial.last, clock(20, 2, 44), kContact_s);
}

TEST(SolarEclipse, IsPartialAtNewYork) {
  const auto covered = [](double second) { return coveredSun(kTotal, kNewYork, second); };
  const double middle = greatest(clock(19, 20), clock(19, 30), covered);
  EXPECT_NEAR(middle, clock(19, 25, 30), 60.0);  // it hardly changes for a minute
  EXPECT_NEAR(covered(middle), 0.896, 0.01);     // over the city by 0.5 %
}

TEST(SolarEclipse, IsARingAtAlbuquerque) {
  const auto covered = [](double second) { return coveredSun(kAnnular, kAlbuquerque, second); };
  // Within the ring the share is that of the squared radii: it does not change but for the distances.
  const Span ring = spanOf(clock(16, 30), clock(16, 45), [&](double second) {
    const SkyBodies bodies = bodiesOn(kAnnular, kAlbuquerque, second);
    const sky::Overlap discs = sky::sunBehindMoon(bodies.sun, *bodies.moon);
    return discs.apart + discs.cover_radius < discs.radius;
  });
  EXPECT_NEAR(0.5 * (ring.first + ring.last), clock(16, 37), kContact_s);
  EXPECT_NEAR(ring.last - ring.first, 4 * 60 + 47, 2.0 * kContact_s);
  EXPECT_NEAR(covered(clock(16, 37)), 0.90, 0.01);
}

TEST(SolarEclipse, IsNoneInSydney) {
  for (int minute = 0; minute < 24 * 60; minute += 10) {
    const SkyBodies bodies = bodiesOn(kTotal, kSydney, 60.0 * minute);
    // Through the Earth, under which the shadow goes on, it is covered.
    if (bodies.sun.apparent.elevation() < Angle::degrees(-18.0)) continue;
    EXPECT_FALSE(sky::sunBehindMoon(bodies.sun, *bodies.moon).touch()) << minute;
  }
}

TEST(LunarEclipse, IsSeenWhenItWas) {
  // 11″ that the middle of the flattened Earth is off, and as much again of how its air is counted: its
  // shadow passes by 0.5″ a second.
  constexpr double kShadow_s = 90.0;
  const auto light = [](double second) { return sunlightOnMoon(kLunar, kDallas, second); };
  const Span penumbra =
      spanOf(clock(3, 45), clock(10, 10), [&](double second) { return light(second) < 1.0; });
  EXPECT_NEAR(penumbra.first, clock(3, 57, 28), kShadow_s);
  EXPECT_NEAR(penumbra.last, clock(10, 0, 9), kShadow_s);
  const Span umbra = spanOf(clock(6, 15), clock(7, 45), [&](double second) { return light(second) == 0.0; });
  EXPECT_NEAR(umbra.first, clock(6, 26, 6), kShadow_s);
  EXPECT_NEAR(umbra.last, clock(7, 31, 26), kShadow_s);
}

TEST(LunarEclipse, IsTheSameFromAnywhere) {
  for (const double second : {clock(4, 30), clock(5, 30), clock(6, 10)})
    EXPECT_NEAR(sunlightOnMoon(kLunar, kDallas, second), sunlightOnMoon(kLunar, kNewYork, second), 0.01);
}

TEST(Eclipses, GoSteadilyAndDimTheGround) {
  const auto groundOn = [](const Day& day, double second) {
    const SkyBodies bodies = bodiesOn(day, kDallas, second);
    return sky::usualAir().daylight(bodies.sun, {bodies.moon, std::nullopt, nullptr}).groundIlluminance();
  };
  // A whole day has 90 klx then, and a full moon's night 0.25 lx.
  EXPECT_LT(groundOn(kTotal, clock(18, 42)).luminance(), 10.0f);
  EXPECT_GT(groundOn(kTotal, clock(18, 42)).luminance(), 1.0f);
  EXPECT_GT(groundOn(kTotal, clock(17, 20)).luminance(), 80e3f);
  EXPECT_LT(groundOn(kLunar, clock(6, 59)).luminance(), 2e-3f);
  EXPECT_GT(groundOn(kLunar, clock(3, 50)).luminance(), 0.1f);
  // Second by second, into totality: the last light goes by less than a half each.
  float before = groundOn(kTotal, clock(18, 40, 0)).luminance();
  for (int second = 1; second <= 60; ++second) {
    const float now = groundOn(kTotal, clock(18, 40, second)).luminance();
    EXPECT_LE(now, before * 1.0001f);
    EXPECT_GT(now, 0.4f * before) << second;
    before = now;
  }
}

}  // namespace
}  // namespace sunlit::studio
