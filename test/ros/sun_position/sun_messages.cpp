#include <gtest/gtest.h>
#include <tf2/LinearMath/Matrix3x3.h>
#include <tf2/LinearMath/Quaternion.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "ros/conversions/geometry.h"
#include "ros/conversions/requests.h"
#include "ros/sun_position/answers.h"
#include "ros/sun_position/options.h"
#include "sunlit/astronomy/celestial.h"
#include "sunlit/astronomy/civil_time.h"
#include "support/message_of.h"

namespace sunlit::ros_interface {
namespace {

SunPosition sunAt(int hour) {
  const SunPositionOptions options;
  CivilDateTime civil = options.date_time;
  civil.hour = hour;
  return toMessage(computeSun(astronomy::instantOf(civil), options.earth, options.site, options.air),
                   headerOf("map", ros::Time(7, 9)));
}

/// The worked example of Reda & Andreas (2008) as a request.
GetSunPosition::Request workedExample() {
  GetSunPosition::Request request;
  request.year = 2003;
  request.month = 10;
  request.day = 17;
  request.hour = 12;
  request.minute = 30;
  request.second = 30.0;
  request.timezone = -7.0;
  request.latitude = 39.742476;
  request.longitude = -105.1786;
  request.elevation = 1830.14;
  request.pressure = 820.0;
  request.temperature = 11.0;
  request.atmospheric_refraction = 0.5667;
  request.delta_t = 67.0;
  request.slope = 30.0;
  request.azm_rotation = -10.0;
  return request;
}

std::string complaint(const GetSunPosition::Request& request) {
  GetSunPosition::Response response;
  return messageOf([&] { answer(request, std_msgs::Header(), &response); });
}

TEST(SunTransform, XPointsTowardsTheSunAndYIsLevel) {
  for (int hour = 0; hour < 24; ++hour) {
    const SunPosition sun = sunAt(hour);
    const geometry_msgs::TransformStamped map_from_sun = toTransform(sun, "h/sun", 250.0);
    const auto& q = map_from_sun.transform.rotation;
    const tf2::Matrix3x3 rotation(tf2::Quaternion(q.x, q.y, q.z, q.w));
    const tf2::Vector3 x = rotation.getColumn(0);
    EXPECT_NEAR(x.x(), sun.direction.x, 1e-12);
    EXPECT_NEAR(x.y(), sun.direction.y, 1e-12);
    EXPECT_NEAR(x.z(), sun.direction.z, 1e-12);
    EXPECT_NEAR(rotation.getColumn(1).z(), 0.0, 1e-12);
    EXPECT_NEAR(map_from_sun.transform.translation.x, 250.0 * sun.direction.x, 1e-9);
    EXPECT_EQ(map_from_sun.header.stamp, ros::Time(7, 9));
    EXPECT_EQ(map_from_sun.header.frame_id, "map");
    EXPECT_EQ(map_from_sun.child_frame_id, "h/sun");
  }
}

TEST(SunMessage, ItsFieldsAgree) {
  const SunPosition sun = sunAt(20);
  EXPECT_NEAR(sun.zenith + sun.elevation, kPi / 2.0, 1e-15);
  EXPECT_NEAR(std::atan2(sun.direction.x, sun.direction.y) + 2.0 * kPi, sun.azimuth, 1e-12);
  EXPECT_NEAR(std::asin(sun.direction.z), sun.elevation, 1e-12);
  EXPECT_LT(sun.elevation_geometric, sun.elevation);
  EXPECT_EQ(sun.utc, "2024-07-01T17:00:00.000Z");  // 20 h at UTC+3
}

TEST(SunMessage, ASunBelowTheHorizonIsDark) {
  EXPECT_LT(toMarker(sunAt(0), "sun", 100.0).color.r, toMarker(sunAt(12), "sun", 100.0).color.r);
}

TEST(MoonMessage, ItsFieldsAreThoseOfThePosition) {
  const SunPositionOptions options;
  const astronomy::MoonPosition moon = astronomy::moonPosition(astronomy::instantOf(options.date_time),
                                                               options.earth, options.site, options.air);
  const MoonPosition message = toMessage(ComputedMoon{astronomy::instantOf(options.date_time), moon},
                                         headerOf("map", ros::Time(7, 9)));
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.header.stamp, ros::Time(7, 9));
  EXPECT_EQ(message.azimuth, moon.azimuth.rad());
  EXPECT_EQ(message.elevation_geometric, moon.elevation_geometric.rad());
  EXPECT_EQ(message.right_ascension, moon.right_ascension.rad());
  EXPECT_EQ(message.declination, moon.declination.rad());
  EXPECT_EQ(message.distance, moon.distance_m);
  EXPECT_EQ(message.phase_angle, moon.phase_angle.rad());
  EXPECT_EQ(message.illuminated_fraction, moon.illuminated_fraction);
  EXPECT_EQ(message.bright_limb_angle, moon.bright_limb.rad());
  const geometry_msgs::TransformStamped transform = toTransform(message, "h/moon", 250.0);
  EXPECT_EQ(transform.child_frame_id, "h/moon");
  EXPECT_NEAR(transform.transform.translation.z, 250.0 * message.direction.z, 1e-9);
  EXPECT_GT(toMarker(message, "moon", 100.0).scale.x, 0.0);
}

TEST(CelestialMessage, ItsQuaternionIsTheRotation) {
  const SunPositionOptions options;
  const Eigen::Matrix3d rotation =
      astronomy::mapFromCelestial(astronomy::instantOf(options.date_time), options.earth, options.site);
  const geometry_msgs::QuaternionStamped message = toMessage(rotation, headerOf("map", ros::Time(7, 9)));
  const auto& q = message.quaternion;
  EXPECT_LT((Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix() - rotation).norm(), 1e-13);
  const geometry_msgs::TransformStamped transform = toTransform(message, "h/celestial");
  EXPECT_EQ(transform.header.frame_id, "map");
  EXPECT_EQ(transform.child_frame_id, "h/celestial");
  EXPECT_EQ(transform.header.stamp, ros::Time(7, 9));
  EXPECT_EQ(transform.transform.rotation.w, q.w);
}

TEST(GetSunPosition, AnswersTheWorkedExample) {
  GetSunPosition::Response response;
  answer(workedExample(), std_msgs::Header(), &response);
  EXPECT_NEAR(response.position.zenith / kRadPerDeg, 50.111622, 1e-6);
  EXPECT_NEAR(response.position.azimuth / kRadPerDeg, 194.340241, 1e-6);
  EXPECT_NEAR(response.incidence / kRadPerDeg, 25.187000, 1e-6);
  EXPECT_NEAR(response.position.equation_of_time, 14.6415 * 60.0, 1e-4 * 60.0);
}

TEST(GetSunPosition, EveryBadFieldIsNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto with = [](auto member, auto value) {
    GetSunPosition::Request request = workedExample();
    request.*member = value;
    return complaint(request);
  };
  using Request = GetSunPosition::Request;
  EXPECT_EQ(with(&Request::year, 7000), "year is 7000, but must be from -2000 to 6000");
  EXPECT_EQ(with(&Request::month, 13), "month is 13, but must be from 1 to 12");
  EXPECT_EQ(with(&Request::day, 32), "day is 32, but must be from 1 to 31 in month 10 of year 2003");
  EXPECT_EQ(with(&Request::hour, 24), "hour is 24, but must be from 0 to 23 h");
  EXPECT_EQ(with(&Request::minute, -1), "minute is -1, but must be from 0 to 59 min");
  EXPECT_EQ(with(&Request::second, nan), "second is nan, but must be from 0 to less than 60 s");
  EXPECT_EQ(with(&Request::timezone, 18.5), "timezone is 18.5, but must be from -18 to 18 h");
  EXPECT_EQ(with(&Request::latitude, 91.0), "latitude is 91, but must be from -90 to 90 deg");
  EXPECT_EQ(with(&Request::longitude, nan), "longitude is nan, but must be from -180 to 180 deg");
  EXPECT_EQ(with(&Request::elevation, -501.0), "elevation is -501, but must be from -500 to 12000 m");
  EXPECT_EQ(with(&Request::pressure, -1.0), "pressure is -1, but must be from 0 to 1200 hPa");
  EXPECT_EQ(with(&Request::temperature, 99.0), "temperature is 99, but must be from -100 to 60 deg C");
  EXPECT_EQ(with(&Request::atmospheric_refraction, 6.0),
            "atmospheric_refraction is 6, but must be from 0 to 5 deg");
  EXPECT_EQ(with(&Request::delta_ut1, 1.5), "delta_ut1 is 1.5, but must be from -1 to 1 s");
  EXPECT_EQ(with(&Request::delta_t, 1e6), "delta_t is 1000000, but must be from -100000 to 100000 s");
  EXPECT_EQ(with(&Request::slope, 361.0), "slope is 361, but must be from -360 to 360 deg");
  EXPECT_EQ(with(&Request::azm_rotation, nan), "azm_rotation is nan, but must be from -360 to 360 deg");
  EXPECT_EQ(complaint(workedExample()), "");
}

TEST(GetSunPosition, DeltaTOfNanIsAutomatic) {
  GetSunPosition::Request request = workedExample();
  GetSunPosition::Response given, automatic;
  answer(request, std_msgs::Header(), &given);
  request.delta_t = std::numeric_limits<double>::quiet_NaN();
  answer(request, std_msgs::Header(), &automatic);
  EXPECT_NE(given.position.azimuth, automatic.position.azimuth);
  EXPECT_NEAR(given.position.azimuth, automatic.position.azimuth, 1e-6);  // 64.5 s, not 67 s
}

TEST(DeltaT, IsNamedWhereItIsNotThatOfTheDate) {
  const auto fault = [](int year, std::optional<double> delta_t_s) {
    return deltaTFault({0.0, delta_t_s}, astronomy::instantOf({year, 7, 1, 12, 0, 0.0, 0.0}));
  };
  const double usual_s = *SunPositionOptions().earth.delta_t_s;
  // Espenak & Meeus: 29 s in 1950, 75 s in 2024, 93 s in 2050, 204 s in mid-2100; 25,400 s in -1000.
  for (const int year : {1950, 2024, 2050}) EXPECT_EQ(fault(year, usual_s), "") << year;
  EXPECT_EQ(fault(2100, usual_s),
            "delta_t is 69.184 s, as given, but of that date it is about 204 s, which auto takes");
  EXPECT_NE(fault(-1000, usual_s).find("about 25"), std::string::npos) << fault(-1000, usual_s);
  EXPECT_EQ(fault(-1000, std::nullopt), "");
  EXPECT_EQ(fault(-1000, 25400.0), "");
}

}  // namespace
}  // namespace sunlit::ros_interface
