#include "sunlit/astronomy/refraction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sunlit::astronomy {
namespace {

const Air kAirs[] = {
    {1013.25, 0.0, Angle::degrees(0.5667)},   {820.0, 11.0, Angle::degrees(0.5667)},
    {1200.0, -100.0, Angle::degrees(0.5667)}, {1013.25, 0.0, Angle::degrees(0.0)},
    {1013.25, 0.0, Angle::degrees(5.0)},      {0.0, 20.0, Angle::degrees(0.5667)},
};

double refractionDeg(double elevation_deg, const Air& air) {
  return refraction(Angle::degrees(elevation_deg), air).deg();
}

/// Eq. 42 of Reda & Andreas (2008), as printed.
double printedFormula(double e0, const Air& air) {
  return air.pressure_hpa / 1010.0 * (283.0 / (273.0 + air.temperature_c)) * 1.02 /
         (60.0 * std::tan((e0 + 10.3 / (e0 + 5.11)) * kRadPerDeg));
}

TEST(Refraction, IsThePublishedFormulaWhileAnyOfTheSunIsUp) {
  for (const Air& air : kAirs) {
    const double sunset = std::max(horizonElevation(air).deg(), -1.9);
    for (double e0 = sunset + 1e-9; e0 <= 90.0; e0 += 0.01) {
      ASSERT_NEAR(refractionDeg(e0, air), printedFormula(e0, air), 1e-12) << "at " << e0;  // rounding only
    }
  }
}

TEST(Refraction, TheSunSetsWhereTheReportSays) {
  EXPECT_NEAR(horizonElevation(kAirs[0]).deg(), -0.83337, 1e-12);
  // The jump that SPA makes there, and this does not.
  EXPECT_NEAR(refractionDeg(-0.8333, kAirs[0]), 0.640, 0.03);
}

TEST(Refraction, ValueAndSlopeAreContinuousFromZenithToNadir) {
  for (const Air& air : kAirs) {
    // Steps of 0.0001°: a jump in value would show as a slope of its size / 0.0001, a kink as a change of
    // slope. The curvature stays below 1 per degree up to the most extreme air, so that slopes of neighbours
    // differ by less than 1e-4.
    constexpr double kStep = 1e-4;
    double last = refractionDeg(-10.0, air);
    double last_slope = 0.0;
    for (int i = 1; i < 200000; ++i) {
      const double e0 = -10.0 + i * kStep;
      const double value = refractionDeg(e0, air);
      const double slope = (value - last) / kStep;
      ASSERT_NEAR(slope, last_slope, 1e-4) << "at " << e0 << " in air of " << air.pressure_hpa << " hPa";
      last = value;
      last_slope = slope;
    }
  }
}

TEST(Refraction, ALowerSunNeverAppearsHigher) {
  for (const Air& air : kAirs) {
    double last = -90.0;
    for (double e0 = -90.0 + 1e-3; e0 <= 89.9; e0 += 1e-3) {
      const double apparent = e0 + refractionDeg(e0, air);
      ASSERT_GT(apparent, last) << "at " << e0;
      last = apparent;
    }
  }
}

TEST(Refraction, IsNothingDeepBelowTheHorizonAndWithoutAir) {
  for (const Air& air : kAirs) EXPECT_EQ(refractionDeg(-7.0, air), 0.0);
  for (double e0 = -90.0; e0 <= 90.0; e0 += 0.1) EXPECT_EQ(refractionDeg(e0, kAirs[5]), 0.0) << "at " << e0;
}

}  // namespace
}  // namespace sunlit::astronomy
