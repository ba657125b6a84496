#include "ros/render/sky_moments.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>

#include "sunlit/quantity/angle.h"

namespace sunlit::ros_interface {
namespace {

sky::SunInSky sunAt(double elevation_deg) {
  const Direction direction(Azimuth::degrees(90.0), Angle::degrees(elevation_deg));
  return {direction, 1.0, direction};
}

double elevationDeg(const std::optional<SkyBodies>& sky) {
  return sky->sun->apparent.elevation().deg();
}

sky::MoonInSky someMoon(double distance_m = 3.844e8) {
  sky::MoonInSky moon;
  moon.apparent = Direction(Eigen::Vector3d::UnitY());
  moon.geometric = moon.apparent;
  moon.distance_m = distance_m;
  return moon;
}

Eigen::Matrix3d starsTurnedBy(double angle_deg) {
  return Eigen::AngleAxisd(Angle::degrees(angle_deg).rad(), Eigen::Vector3d::UnitX()).toRotationMatrix();
}

constexpr double kMoves = 600.0;
const SkyTime kMoving{std::nullopt, kMoves};

TEST(SkyMoments, AreWholeOnlyWithAllThreeOfOneStamp) {
  SkyMoments moments(true);
  moments.put(ros::Time(1), sunAt(10.0));
  moments.put(ros::Time(1), someMoon());
  moments.put(ros::Time(2), starsTurnedBy(1.0));
  EXPECT_TRUE(moments.whole().empty());
  moments.put(ros::Time(1), starsTurnedBy(1.0));
  EXPECT_EQ(moments.whole().size(), 1u);
  EXPECT_TRUE(moments.at(ros::Time(1)));
}

TEST(SkyMoments, OfASkyThatStandsStillHoldUntilTheNextAndBeforeTheFirst) {
  SkyMoments moments(false);
  moments.put(ros::Time(10), sunAt(10.0));
  moments.put(ros::Time(20), sunAt(20.0));
  EXPECT_NEAR(elevationDeg(moments.at(ros::Time(1))), 10.0, 1e-12);  // rounding, here and below
  EXPECT_NEAR(elevationDeg(moments.at(ros::Time(19))), 10.0, 1e-12);
  EXPECT_NEAR(elevationDeg(moments.at(ros::Time(20))), 20.0, 1e-12);
  EXPECT_NEAR(elevationDeg(moments.at(ros::Time(1000))), 20.0, 1e-12);
}

TEST(SkyMoments, OfASkyThatMovesAreNeverContinued) {
  SkyMoments moments(false);
  moments.put(ros::Time(10), sunAt(10.0), kMoving);
  moments.put(ros::Time(12), sunAt(14.0), kMoving);
  EXPECT_FALSE(moments.at(ros::Time(9)));
  EXPECT_TRUE(moments.missed(ros::Time(9)));  // moments come in order
  EXPECT_NEAR(elevationDeg(moments.at(ros::Time(11))), 12.0, 1e-9);
  EXPECT_FALSE(moments.at(ros::Time(13)));
  EXPECT_FALSE(moments.missed(ros::Time(13)));  // it is on its way
}

TEST(SkyMoments, BetweenWhichClockOrPlaceWereSetNothingStood) {
  const Instant noon(2460000, 0);
  const SkyTime at_noon{noon, 1.0};
  const auto halfWay = [&](const sky::SunInSky& sun, const SkyTime& time, double site_elevation_m) {
    SkyMoments moments(false);
    moments.put(ros::Time(10), sunAt(40.0), at_noon);
    moments.put(ros::Time(11), sun, time, site_elevation_m);
    const std::optional<SkyBodies> sky = moments.at(ros::Time(10, 500000000));
    EXPECT_TRUE(sky);
    return std::array<double, 3>{elevationDeg(sky), sky->site_elevation_m, sky->time.utc->secondsSince(noon)};
  };
  // A second on, as it should be.
  EXPECT_NEAR(halfWay(sunAt(40.004), {noon.plusSeconds(1.0), 1.0}, 0.0)[0], 40.002, 1e-9);
  const std::array<double, 3> first = halfWay(sunAt(40.0), at_noon, 0.0);
  EXPECT_EQ(halfWay(sunAt(10.0), {noon.plusSeconds(6 * 3600.0), 1.0}, 0.0), first);           // another hour
  EXPECT_EQ(halfWay(sunAt(40.0), {noon.plusSeconds(365 * 86400.0 + 1.0), 1.0}, 0.0), first);  // another year
  EXPECT_EQ(halfWay(sunAt(20.0), {noon.plusSeconds(1.0), 1.0}, 0.0), first);                  // another place
  EXPECT_EQ(halfWay(sunAt(40.0), {noon.plusSeconds(1.0), 1.0}, 2000.0), first);               // up a mountain
  EXPECT_EQ(halfWay(sunAt(40.004), {noon.plusSeconds(1.0), 60.0}, 0.0), first);               // another rate
}

TEST(SkyMoments, WhereTheRuleIsExactAnswerForTheirOwnStampsAlone) {
  SkyMoments moments(false, SkyRule::kExact);
  for (const int second : {10, 12}) moments.put(ros::Time(second), sunAt(second));  // it even stands still
  EXPECT_TRUE(moments.at(ros::Time(10)));
  EXPECT_TRUE(moments.at(ros::Time(12)));
  EXPECT_FALSE(moments.at(ros::Time(11)));
  EXPECT_TRUE(moments.missed(ros::Time(11)));
  EXPECT_FALSE(moments.at(ros::Time(13)));
  EXPECT_FALSE(moments.missed(ros::Time(13)));
}

TEST(SkyMoments, BetweenTwoTurnMoonStarsAndTime) {
  SkyMoments moments(true);
  const Instant then(2460000, 0);
  for (const int second : {0, 1}) {
    const ros::Time stamp(100 + second);
    moments.put(stamp, sunAt(5.0 + second), {then.plusSeconds(kMoves * second), kMoves});
    moments.put(stamp, someMoon(3.8e8 + 1e6 * second));
    moments.put(stamp, starsTurnedBy(2.0 * second));
  }
  const std::optional<SkyBodies> sky = moments.at(ros::Time(100, 250000000));
  ASSERT_TRUE(sky);
  EXPECT_NEAR(elevationDeg(sky), 5.25, 1e-9);
  EXPECT_NEAR(sky->moon->distance_m, 3.8e8 + 2.5e5, 1e-3);
  EXPECT_LT((*sky->map_from_celestial - starsTurnedBy(0.5)).norm(), 1e-12);
  EXPECT_EQ(sky->time.utc, then.plusSeconds(150.0));
}

TEST(SkyMoments, ForgetOnlyWhatNoLaterStampNeeds) {
  SkyMoments moments(false);
  for (int second = 0; second < 10; ++second) moments.put(ros::Time(second), sunAt(second), kMoving);
  moments.forgetBefore(ros::Time(4, 500000000));
  EXPECT_EQ(moments.whole().begin()->first, ros::Time(4));
  EXPECT_NEAR(elevationDeg(moments.at(ros::Time(4, 500000000))), 4.5, 1e-9);
  moments.forgetBefore(ros::Time(0));
  EXPECT_EQ(moments.whole().size(), 6u);
}

TEST(SkyMoments, StayBoundedHoweverFarAReaderIsBehind) {
  SkyMoments moments(false);
  constexpr int kCount = 100000;
  for (int i = 0; i <= kCount; ++i) moments.put(ros::Time(1000 + i), sunAt(90.0 * i / kCount), kMoving);
  EXPECT_LE(moments.whole().size(), 20000u);
  EXPECT_EQ(moments.whole().begin()->first, ros::Time(1000));
  EXPECT_NEAR(elevationDeg(moments.at(ros::Time(1000 + kCount / 3))), 30.0, 1e-3);
  EXPECT_NEAR(elevationDeg(moments.at(ros::Time(1000 + kCount))), 90.0, 1e-5);  // asin near its end
}

TEST(SkyMoments, TellHowFarApartTheyAreWhereTheSkyMoves) {
  SkyMoments moments(false);
  moments.put(ros::Time(10), sunAt(10.0), kMoving);
  moments.put(ros::Time(12), sunAt(14.0), kMoving);
  moments.put(ros::Time(13), sunAt(14.0));
  moments.put(ros::Time(15), sunAt(14.0));
  EXPECT_EQ(moments.spacing(ros::Time(11)), 2.0);
  for (const double stamp : {9.0, 10.0, 12.0, 14.0, 16.0}) EXPECT_EQ(moments.spacing(ros::Time(stamp)), 0.0);
}

TEST(SkyMoments, ShineAlikeWhateverTimeItIs) {
  SkyBodies a;
  a.sun = sunAt(3.0);
  SkyBodies b = a;
  b.time = kMoving;
  EXPECT_TRUE(shineAlike(a, b));
  b.sun = sunAt(3.0000001);
  EXPECT_FALSE(shineAlike(a, b));
}

TEST(SkyMoments, FollowAClockThatJumpsBack) {
  SkyMoments moments(false);
  moments.put(ros::Time(100), sunAt(10.0));
  moments.put(ros::Time(1), sunAt(20.0));
  EXPECT_NEAR(elevationDeg(moments.at(ros::Time(100))), 20.0, 1e-12);
}

TEST(SkyMoments, ForgetWhatCameBeforeTheClockJumpedBack) {
  SkyMoments moments(true);
  for (int second = 1000; second < 1200; ++second) {
    moments.put(ros::Time(second), sunAt(1.0));
    moments.put(ros::Time(second), someMoon());
  }
  moments.put(ros::Time(1200), sunAt(1.0));
  moments.put(ros::Time(10), sunAt(2.0));
  moments.put(ros::Time(10), someMoon());
  moments.put(ros::Time(1200), someMoon());
  moments.put(ros::Time(1200), starsTurnedBy(1.0));
  EXPECT_TRUE(moments.whole().empty());  // that sun of 1200 was of the time before the jump
  moments.put(ros::Time(1200), sunAt(3.0));
  EXPECT_NEAR(elevationDeg(moments.at(ros::Time(1200))), 3.0, 1e-12);
}

TEST(SkyMoments, OfAnEarlierTimeBecomeWholeWhileManyOfALaterOneWait) {
  SkyMoments moments(true);
  for (int second = 1000; second < 1200; ++second) moments.put(ros::Time(second), sunAt(1.0));
  moments.put(ros::Time(10), someMoon());
  moments.put(ros::Time(10), sunAt(1.0));
  moments.put(ros::Time(10), starsTurnedBy(1.0));
  EXPECT_TRUE(moments.at(ros::Time(10)));
}

}  // namespace
}  // namespace sunlit::ros_interface
