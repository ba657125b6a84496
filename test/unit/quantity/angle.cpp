#include "sunlit/quantity/angle.h"

#include <gtest/gtest.h>

#include <type_traits>

namespace sunlit {
namespace {

TEST(Angle, DegreesAndRadiansAreTheSameAngle) {
  EXPECT_DOUBLE_EQ(Angle::degrees(180.0).rad(), kPi);
  EXPECT_DOUBLE_EQ(Angle::radians(kPi / 6.0).deg(), 30.0);
  EXPECT_NEAR(sin(Angle::degrees(30.0)), 0.5, 1e-15);
  EXPECT_NEAR(cos(Angle::degrees(60.0)), 0.5, 1e-15);
  EXPECT_NEAR(tan(Angle::degrees(45.0)), 1.0, 1e-15);
}

TEST(Angle, CalculatesAndCompares) {
  const Angle a = Angle::degrees(50.0);
  const Angle b = Angle::degrees(20.0);
  EXPECT_DOUBLE_EQ((a + b).deg(), 70.0);
  EXPECT_DOUBLE_EQ((a - b).deg(), 30.0);
  EXPECT_DOUBLE_EQ((-a).deg(), -50.0);
  EXPECT_DOUBLE_EQ((a * 2.0).deg(), 100.0);
  EXPECT_DOUBLE_EQ((a / 2.0).deg(), 25.0);
  EXPECT_TRUE(b < a && a > b && a >= a && a <= a && a == a && a != b);
}

TEST(Angle, LimitsTypedInDegreesSurviveTheWayThroughRadians) {
  // Ranges are checked in degrees, so the ends must come back exactly.
  for (const double deg : {-360.0, -180.0, -90.0, 0.0, 5.0, 90.0, 180.0, 360.0}) {
    EXPECT_EQ(Angle::degrees(deg).deg(), deg);
  }
}

TEST(Angle, IsNotMadeFromABareNumber) {
  EXPECT_FALSE((std::is_convertible<double, Angle>::value));
  EXPECT_FALSE((std::is_convertible<double, Azimuth>::value));
  EXPECT_FALSE((std::is_convertible<Angle, Azimuth>::value));
}

TEST(Azimuth, LiesInOneTurn) {
  EXPECT_DOUBLE_EQ(Azimuth::degrees(-90.0).deg(), 270.0);
  EXPECT_NEAR(Azimuth::degrees(725.0).deg(), 5.0, 1e-13);  // as many digits as 725 has
  EXPECT_EQ(Azimuth::degrees(0.0).deg(), 0.0);
  EXPECT_EQ(Azimuth::degrees(360.0).deg(), 0.0);
  // So close below zero that adding a turn rounds to the turn itself.
  EXPECT_EQ(Azimuth(Angle::radians(-1e-20)).rad(), 0.0);
}

}  // namespace
}  // namespace sunlit
