#include "sunlit/astronomy/delta_t.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sunlit/astronomy/civil_time.h"

namespace sunlit::astronomy {
namespace {

double inYear(int year) {
  return deltaT(instantOf({year, 1, 1, 0, 0, 0.0, 0.0}));
}

TEST(DeltaT, IsThatOfThePublishedTable) {
  // Espenak & Meeus (2006), tables 1 and 2: rounded to 10 s or 100 s before 1600 (the fit is as good), then
  // to 1 s and 0.1 s.
  EXPECT_NEAR(inYear(-500), 17190, 50);
  EXPECT_NEAR(inYear(0), 10580, 50);
  EXPECT_NEAR(inYear(500), 5710, 50);
  EXPECT_NEAR(inYear(1000), 1570, 50);
  EXPECT_NEAR(inYear(1500), 200, 20);
  EXPECT_NEAR(inYear(1700), 9, 1);
  EXPECT_NEAR(inYear(1800), 14, 1);
  EXPECT_NEAR(inYear(1900), -3, 1);
  EXPECT_NEAR(inYear(1955), 31.1, 0.3);
  EXPECT_NEAR(inYear(1980), 50.5, 0.3);
  EXPECT_NEAR(inYear(2000), 63.8, 0.1);
  EXPECT_NEAR(inYear(2005), 64.7, 0.2);
}

TEST(DeltaT, ForecastsAreThePublishedOnes) {
  EXPECT_NEAR(inYear(2050), 93.0, 0.1);   // same document: "93 seconds by 2050"
  EXPECT_NEAR(inYear(2100), 202.7, 1.0);  // "203 seconds by 2100"
  EXPECT_NEAR(inYear(2200), 442.1, 1.0);  // −20 + 32·3.8²
}

TEST(DeltaT, PiecesJoinAsTheContractSays) {
  // Change of the step from day to day: inside a piece below 1e-3 s, at a joint the size of its gap.
  double before = deltaT(Instant(julianDayNumber(-2000, 1, 1), 0));
  double value = deltaT(Instant(julianDayNumber(-2000, 1, 2), 0));
  for (std::int64_t day = julianDayNumber(-2000, 1, 3); day < julianDayNumber(6000, 12, 31); ++day) {
    const double next = deltaT(Instant(day, 0));
    ASSERT_LT(std::abs(next - 2.0 * value + before), 0.3) << "at JD " << day;
    before = value;
    value = next;
  }
}

}  // namespace
}  // namespace sunlit::astronomy
