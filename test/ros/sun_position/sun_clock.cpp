#include "ros/sun_position/sun_clock.h"

#include <gtest/gtest.h>

#include "sunlit/astronomy/civil_time.h"

namespace sunlit::ros_interface {
namespace {

const Instant kNoon = astronomy::instantOf({2024, 7, 1, 12, 0, 0.0, 3.0});

TEST(SunClock, RunsAtItsRateFromTheFirstValidTime) {
  SunClock clock(kNoon, 60.0);
  EXPECT_EQ(clock.at(ros::Time(0.0)), kNoon) << "nobody has published /clock yet";
  EXPECT_EQ(clock.at(ros::Time(1000.0)), kNoon);
  EXPECT_EQ(clock.at(ros::Time(1001.5)), kNoon.plusSeconds(90.0));
}

TEST(SunClock, ShowsItsDateAtTheStampThatItIsTold) {
  SunClock clock(kNoon, 60.0, ros::Time(1000.0));
  EXPECT_EQ(clock.at(ros::Time(0.0)), kNoon);
  EXPECT_EQ(clock.at(ros::Time(1030.0)), kNoon.plusSeconds(1800.0)) << "wherever it begins";
  EXPECT_EQ(clock.at(ros::Time(999.0)), kNoon.plusSeconds(-60.0));
}

TEST(SunClock, StandsStillAtRateZeroAndRunsBackwardsBelow) {
  SunClock frozen(kNoon, 0.0);
  SunClock backwards(kNoon, -2.0);
  frozen.at(ros::Time(10.0));
  backwards.at(ros::Time(10.0));
  EXPECT_EQ(frozen.at(ros::Time(1e6)), kNoon);
  EXPECT_EQ(backwards.at(ros::Time(20.0)), kNoon.plusSeconds(-20.0));
}

TEST(SunClock, PausesAndJumpsBackWithRosTime) {
  SunClock clock(kNoon, 1.0);
  clock.at(ros::Time(100.0));
  const Instant later = clock.at(ros::Time(200.0));
  EXPECT_EQ(clock.at(ros::Time(200.0)), later);
  EXPECT_EQ(clock.at(ros::Time(150.0)), kNoon.plusSeconds(50.0));
  EXPECT_EQ(clock.at(ros::Time(40.0)), kNoon.plusSeconds(-60.0)) << "before its start";
  EXPECT_EQ(clock.at(ros::Time(200.0)), later) << "no history";
}

// Whatever the time zone makes of them.
TEST(SunClock, ShowsAllOfTheFirstAndTheLastDay) {
  for (const CivilDateTime& civil :
       {CivilDateTime{6000, 12, 31, 12, 0, 0.0, 0.0}, CivilDateTime{6000, 12, 31, 23, 59, 59.9, -18.0},
        CivilDateTime{-2000, 1, 1, 0, 0, 0.0, 18.0}}) {
    const Instant date = astronomy::instantOf(civil);
    SunClock clock(date, 0.0);
    clock.at(ros::Time(10.0));
    EXPECT_EQ(clock.at(ros::Time(20.0)), date) << civil.year;
    EXPECT_FALSE(clock.atLimit());
  }
}

TEST(SunClock, IsHeldAtTheEndsOfTheSupportedYears) {
  SunClock clock(kNoon, 1e8);
  clock.at(ros::Time(1.0));
  EXPECT_FALSE(clock.atLimit());
  EXPECT_EQ(astronomy::civilOf(clock.at(ros::Time(1e9)), 0.0).year, 6000);
  EXPECT_TRUE(clock.atLimit());
  EXPECT_EQ(clock.at(ros::Time(1.0)), kNoon);
  EXPECT_FALSE(clock.atLimit());
  SunClock backwards(kNoon, -1e8);
  backwards.at(ros::Time(1.0));
  EXPECT_EQ(astronomy::civilOf(backwards.at(ros::Time(1e9)), 0.0).year, -2000);
  EXPECT_TRUE(backwards.atLimit());
}

}  // namespace
}  // namespace sunlit::ros_interface
