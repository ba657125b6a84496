#include "sunlit/quantity/instant.h"

#include <gtest/gtest.h>

namespace sunlit {
namespace {

constexpr std::int64_t kDay = Instant::kNanosecondsPerDay;

TEST(Instant, CarriesNanosecondsIntoDays) {
  EXPECT_EQ(Instant(10, kDay), Instant(11, 0));
  EXPECT_EQ(Instant(10, -1), Instant(9, kDay - 1));
  EXPECT_EQ(Instant(10, -kDay), Instant(9, 0));
  EXPECT_EQ(Instant(10, 5 * kDay + 7), Instant(15, 7));
  EXPECT_EQ(Instant(-3, -kDay / 2), Instant(-4, kDay / 2));
}

TEST(Instant, ResolvesANanosecondInAnyYear) {
  for (const std::int64_t day : {std::int64_t{0}, std::int64_t{2451545}, std::int64_t{3912515}}) {
    const Instant instant(day, kDay - 1);
    EXPECT_NE(instant, instant.plusNanoseconds(1));
    EXPECT_TRUE(instant < instant.plusNanoseconds(1));
    EXPECT_EQ(instant.plusNanoseconds(1), Instant(day + 1, 0));
    // Across midnight the difference of two times of day of 86400 s: 1.5e-11 s.
    EXPECT_NEAR(instant.plusNanoseconds(1).secondsSince(instant), 1e-9, 1.5e-11);
  }
}

TEST(Instant, SecondsAddUp) {
  const Instant instant(2451545, 123456789);
  for (const double s : {0.0, 1.0, -1.0, 0.25, -0.25, 86400.0, -86400.0, 1e6 + 0.5, -1e6 - 0.5}) {
    EXPECT_EQ(instant.plusSeconds(s).secondsSince(instant), s);  // all exact in binary and in nanoseconds
    EXPECT_EQ(instant.plusSeconds(s).plusSeconds(-s), instant);
  }
  // 8000 years: one double of seconds resolves 30 µs.
  EXPECT_NEAR(instant.plusSeconds(2.5e11).secondsSince(instant), 2.5e11, 1e-4);
}

TEST(Instant, JulianDateIsNoonBased) {
  EXPECT_EQ(Instant().julianDate(), 2451545.0);
  EXPECT_EQ(Instant(2451545, kDay / 2).julianDate(), 2451545.5);
  EXPECT_EQ(Instant(2451545, kDay / 4).dayFraction(), 0.25);
}

}  // namespace
}  // namespace sunlit
