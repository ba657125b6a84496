#include "sunlit/astronomy/civil_time.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include "sunlit/quantity/site.h"
#include "support/message_of.h"

namespace sunlit::astronomy {
namespace {

constexpr std::int64_t kHalfDay = Instant::kNanosecondsPerDay / 2;

/// The message of the exception that `civil` causes; empty if it causes none.
std::string complaint(const CivilDateTime& civil) {
  return messageOf([&] { instantOf(civil); });
}

TEST(JulianDay, PublishedDates) {
  // Meeus, Astronomical Algorithms, chapter 7, and Reda & Andreas (2008), Table A4.1. All at noon.
  EXPECT_EQ(julianDayNumber(2000, 1, 1), 2451545);
  EXPECT_EQ(julianDayNumber(1999, 1, 1), 2451180);
  EXPECT_EQ(julianDayNumber(1987, 1, 27), 2446823);
  EXPECT_EQ(julianDayNumber(1987, 6, 19), 2446966);
  EXPECT_EQ(julianDayNumber(1988, 1, 27), 2447188);
  EXPECT_EQ(julianDayNumber(1988, 6, 19), 2447332);
  EXPECT_EQ(julianDayNumber(1900, 1, 1), 2415021);
  EXPECT_EQ(julianDayNumber(1600, 1, 1), 2305448);
  EXPECT_EQ(julianDayNumber(1600, 12, 31), 2305813);
  EXPECT_EQ(julianDayNumber(837, 4, 10), 2026872);
  EXPECT_EQ(julianDayNumber(-123, 12, 31), 1676497);
  EXPECT_EQ(julianDayNumber(-122, 1, 1), 1676498);
  EXPECT_EQ(julianDayNumber(-1000, 7, 12), 1356001);
  EXPECT_EQ(julianDayNumber(-1001, 8, 17), 1355671);
  EXPECT_EQ(julianDayNumber(-4712, 1, 1), 0);
}

TEST(JulianDay, DateAndTimeOfDay) {
  // 837-04-10 07:12 is JD 2026871.8: a double of this size resolves 2.3e-10 days.
  EXPECT_NEAR(instantOf({837, 4, 10, 7, 12, 0.0, 0.0}).julianDate(), 2026871.8, 5e-10);
  EXPECT_EQ(instantOf({2000, 1, 1, 12, 0, 0.0, 0.0}), Instant());
}

TEST(JulianDay, TheGregorianCalendarFollowsTheJulianWithoutAGap) {
  EXPECT_EQ(julianDayNumber(1582, 10, 15), julianDayNumber(1582, 10, 4) + 1);
}

TEST(CivilTime, TimezoneIsEastOfUtc) {
  EXPECT_EQ(instantOf({2024, 7, 1, 12, 0, 0.0, 3.0}), instantOf({2024, 7, 1, 9, 0, 0.0, 0.0}));
  EXPECT_EQ(instantOf({2024, 7, 1, 0, 30, 0.0, 5.5}), instantOf({2024, 6, 30, 19, 0, 0.0, 0.0}));
}

TEST(CivilTime, Hour24IsTheNextMidnight) {
  EXPECT_EQ(instantOf({2023, 12, 31, 24, 0, 0.0, 0.0}), instantOf({2024, 1, 1, 0, 0, 0.0, 0.0}));
}

TEST(CivilTime, EveryDayOfAllSupportedYearsComesBack) {
  std::int64_t expected = julianDayNumber(-2000, 1, 1);
  for (int year = -2000; year <= 6000; ++year) {
    for (int month = 1; month <= 12; ++month) {
      for (int day = 1; day <= daysInMonth(year, month); ++day) {
        if (year == 1582 && month == 10 && day > 4 && day < 15) continue;
        ASSERT_EQ(julianDayNumber(year, month, day), expected) << year << "-" << month << "-" << day;
        const CivilDateTime civil = civilOf(Instant(expected, 0), 0.0);
        ASSERT_EQ(civil.year, year);
        ASSERT_EQ(civil.month, month);
        ASSERT_EQ(civil.day, day);
        ++expected;
      }
    }
  }
}

TEST(CivilTime, RandomInstantsComeBackToTheNanosecond) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::int64_t> day(julianDayNumber(-1999, 1, 1),
                                                  julianDayNumber(5999, 12, 31));
  std::uniform_int_distribution<std::int64_t> nanosecond(0, Instant::kNanosecondsPerDay - 1);
  std::uniform_int_distribution<int> quarter_hours(-72, 72);
  for (int i = 0; i < 10000; ++i) {
    const Instant instant(day(random), nanosecond(random));
    ASSERT_EQ(instantOf(civilOf(instant, quarter_hours(random) / 4.0)), instant);
  }
}

TEST(CivilTime, BadFieldsAreNamedWithValueAndRange) {
  EXPECT_EQ(complaint({7000, 1, 1, 0, 0, 0.0, 0.0}), "year is 7000, but must be from -2000 to 6000");
  EXPECT_EQ(complaint({-2001, 1, 1, 0, 0, 0.0, 0.0}), "year is -2001, but must be from -2000 to 6000");
  EXPECT_EQ(complaint({2024, 13, 1, 0, 0, 0.0, 0.0}), "month is 13, but must be from 1 to 12");
  EXPECT_EQ(complaint({2024, 0, 1, 0, 0, 0.0, 0.0}), "month is 0, but must be from 1 to 12");
  EXPECT_EQ(complaint({2023, 2, 31, 0, 0, 0.0, 0.0}),
            "day is 31, but must be from 1 to 28 in month 2 of year 2023");
  EXPECT_EQ(complaint({2024, 2, 30, 0, 0, 0.0, 0.0}),
            "day is 30, but must be from 1 to 29 in month 2 of year 2024");
  EXPECT_EQ(complaint({1900, 2, 29, 0, 0, 0.0, 0.0}),
            "day is 29, but must be from 1 to 28 in month 2 of year 1900");
  EXPECT_EQ(complaint({2024, 4, 0, 0, 0, 0.0, 0.0}),
            "day is 0, but must be from 1 to 30 in month 4 of year 2024");
  EXPECT_EQ(complaint({2024, 7, 1, 25, 0, 0.0, 0.0}), "hour is 25, but must be from 0 to 23 h");
  EXPECT_EQ(complaint({2024, 7, 1, 24, 1, 0.0, 0.0}), "hour is 24, but must be from 0 to 23 h");
  EXPECT_EQ(complaint({2024, 7, 1, 0, 60, 0.0, 0.0}), "minute is 60, but must be from 0 to 59 min");
  EXPECT_EQ(complaint({2024, 7, 1, 0, 0, 60.0, 0.0}), "second is 60, but must be from 0 to less than 60 s");
  EXPECT_EQ(complaint({2024, 7, 1, 0, 0, -0.5, 0.0}), "second is -0.5, but must be from 0 to less than 60 s");
  EXPECT_EQ(complaint({2024, 7, 1, 0, 0, 0.0, 19.0}), "timezone is 19, but must be from -18 to 18 h");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(complaint({2024, 7, 1, 0, 0, nan, 0.0}), "second is nan, but must be from 0 to less than 60 s");
  EXPECT_EQ(complaint({2024, 7, 1, 0, 0, 0.0, nan}), "timezone is nan, but must be from -18 to 18 h");
  EXPECT_EQ(complaint({1900, 1, 1, 0, 0, 0.0, 0.0}), "");
  EXPECT_EQ(complaint({1500, 2, 29, 0, 0, 0.0, 0.0}), "") << "a leap year of the Julian calendar";
}

TEST(CivilTime, TheTenLeftOutDaysDoNotExist) {
  EXPECT_EQ(complaint({1582, 10, 4, 0, 0, 0.0, 0.0}), "");
  EXPECT_NE(complaint({1582, 10, 5, 0, 0, 0.0, 0.0}).find("day is 5"), std::string::npos);
  EXPECT_NE(complaint({1582, 10, 14, 0, 0, 0.0, 0.0}).find("day is 14"), std::string::npos);
  EXPECT_EQ(complaint({1582, 10, 15, 0, 0, 0.0, 0.0}), "");
}

TEST(Fields, BadPlacesAndAirAreNamed) {
  const auto complaintOf = [](const auto& thing) { return messageOf([&] { requireFields(thing); }); };
  EXPECT_EQ(complaintOf(Site{Angle::degrees(91), Angle(), 0.0}),
            "latitude is 91, but must be from -90 to 90 deg");
  EXPECT_EQ(complaintOf(Site{Angle(), Angle::degrees(-181), 0.0}),
            "longitude is -181, but must be from -180 to 180 deg");
  EXPECT_EQ(complaintOf(Site{Angle(), Angle(), 12001}),
            "elevation is 12001, but must be from -500 to 12000 m");
  EXPECT_EQ(complaintOf(Air{-1.0, 0.0, Angle()}), "pressure is -1, but must be from 0 to 1200 hPa");
  EXPECT_EQ(complaintOf(Air{0.0, 61.0, Angle()}), "temperature is 61, but must be from -100 to 60 deg C");
  EXPECT_EQ(complaintOf(Air{0.0, 0.0, Angle::degrees(6)}),
            "atmospheric_refraction is 6, but must be from 0 to 5 deg");
  // The ends belong to the range, also after their way through radians.
  EXPECT_EQ(complaintOf(Site{Angle::degrees(-90), Angle::degrees(180), -500}), "");
  EXPECT_EQ(complaintOf(Air{1200, -100, Angle::degrees(5)}), "");
}

TEST(CivilTime, MidnightIsTheStartOfTheLocalDay) {
  EXPECT_EQ(midnightOf({2024, 7, 1, 3.0}), instantOf({2024, 7, 1, 0, 0, 0.0, 3.0}));
  EXPECT_EQ(midnightOf({2000, 1, 1, 0.0}), Instant(2451544, kHalfDay));
}

}  // namespace
}  // namespace sunlit::astronomy
