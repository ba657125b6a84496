#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ros/conversions/geometry.h"
#include "ros/conversions/images.h"
#include "ros/conversions/received_images.h"
#include "ros/conversions/sky.h"
#include "ros/conversions/time.h"
#include "ros/evaluator/sequence_gaps.h"
#include "sunlit/astronomy/civil_time.h"
#include "sunlit/sky/eclipse.h"
#include "support/message_of.h"

namespace sunlit::ros_interface {
namespace {

const std_msgs::Header kHeader = headerOf("camera_optical_frame", ros::Time(5));

TEST(Messages, ADepthImageKeepsItsBits) {
  image::DepthImage depth(3, 2);
  depth.data = {1.5f, 2.5f, 3.5f, std::numeric_limits<float>::quiet_NaN(), 5.5f, 6.5f};
  const sensor_msgs::ImagePtr message = toImageMessage(depth, kHeader);
  EXPECT_EQ(message->encoding, "32FC1");
  EXPECT_EQ(message->step, 12u);
  ASSERT_EQ(message->data.size(), 24u);
  EXPECT_EQ(std::memcmp(message->data.data(), depth.data.data(), 24), 0);
}

TEST(Messages, ADepthImageWhoseRowsBeginWithinANumberIsAFault) {
  for (const auto& [encoding, step] : {std::pair<const char*, std::uint32_t>{"16UC1", 7}, {"32FC1", 14}}) {
    sensor_msgs::Image message;
    message.encoding = encoding;
    message.width = 3;
    message.height = 2;
    message.step = step;
    message.data.resize(std::size_t{2} * step);
    const DecodedDepth decoded = decodeDepth(message, 100);
    EXPECT_TRUE(decoded.metres.empty());
    EXPECT_EQ(decoded.fault, encoding == std::string("16UC1")
                                 ? "step 7 is no multiple of the 2 bytes of a number of 16UC1"
                                 : "step 14 is no multiple of the 4 bytes of a number of 32FC1");
  }
}

TEST(Messages, AnImageWhoseRowsBeginWithinANumberIsAFault) {
  sensor_msgs::Image message;
  message.encoding = "mono16";
  message.width = 3;
  message.height = 2;
  message.step = 7;
  message.data.resize(14);
  EXPECT_EQ(decode(message, 100).fault, "step 7 is no multiple of the 2 bytes of a number of mono16");
}

TEST(Messages, DepthThatNoCameraMeasuresIsNone) {
  constexpr float kNothing = std::numeric_limits<float>::max();  // as some cameras send it
  image::DepthImage depth(3, 2);
  depth.data = {1.5f, 1e28f, kNothing, std::numeric_limits<float>::infinity(), 5.5f, 0.0f};
  DecodedDepth decoded = decodeDepth(*toImageMessage(depth, kHeader), 100);
  ASSERT_EQ(decoded.fault, "");
  EXPECT_FLOAT_EQ(decoded.metres.at<float>(0, 0), 1.5f);
  EXPECT_TRUE(std::isnan(decoded.metres.at<float>(0, 1)));
  EXPECT_FLOAT_EQ(decoded.metres.at<float>(1, 1), 5.5f);
  depth.data = {1e28f, 1e28f, kNothing, std::numeric_limits<float>::quiet_NaN(), 5.5f, -1.0f};
  decoded = decodeDepth(*toImageMessage(depth, kHeader), 100);
  EXPECT_TRUE(decoded.metres.empty());
  EXPECT_EQ(
      decoded.fault,
      "2 of 3 depths are not between 0.001 and 1e+06 m, as 1e+28: 32FC1 must be metres, in the order of "
      "bytes that is_bigendian tells");
  // As of a driver that makes floats of 16UC1, and no more.
  depth.data = {1420.0f, 21873.0f, kNothing, 0.0f, 5310.0f, 1420.0f};
  EXPECT_EQ(decodeDepth(*toImageMessage(depth, kHeader), 100).fault,
            "depths from 1420 to 21873 m are whole numbers: 32FC1 must be metres; millimetres are of 16UC1");
  depth.data.assign(6, 2000.0f);  // a wall in front, or the ground from far above
  EXPECT_EQ(decodeDepth(*toImageMessage(depth, kHeader), 100).fault, "");
  // Into the sky there is nothing, which is no fault.
  depth.data.assign(6, std::numeric_limits<float>::infinity());
  EXPECT_EQ(decodeDepth(*toImageMessage(depth, kHeader), 100).fault, "");
}

/// One pixel of each of these numbers beside the other, of which `channels` make a pixel.
sensor_msgs::Image imageOf(const std::string& encoding, std::uint32_t channels,
                           const std::vector<std::string>& numbers) {
  sensor_msgs::Image message;
  message.encoding = encoding;
  message.height = 1;
  message.width = static_cast<std::uint32_t>(numbers.size()) / channels;
  for (const std::string& number : numbers)
    message.data.insert(message.data.end(), number.begin(), number.end());
  message.step = static_cast<std::uint32_t>(message.data.size());
  return message;
}

/// The same numbers, of the other order of bytes.
sensor_msgs::Image inOtherOrder(sensor_msgs::Image message, std::size_t bytes_of_number) {
  message.is_bigendian = message.is_bigendian == 0 ? 1 : 0;
  for (auto at = message.data.begin(); at != message.data.end(); at += bytes_of_number)
    std::reverse(at, at + bytes_of_number);
  return message;
}

/// The high byte of these is the value of 8 bit: v · 255 / 65535 is v / 257, and 0x4040 is 64 · 257.
TEST(Messages, ImagesOf16BitAreReadInEitherOrderOfBytes) {
  for (const auto& [encoding, channels] :
       {std::pair<const char*, std::uint32_t>{"mono16", 1}, {"rgb16", 3}}) {
    sensor_msgs::Image little = imageOf(encoding, channels, {"\x40\x40", "\x41\x40", "\x30\x20"});
    for (const sensor_msgs::Image& message : {little, inOtherOrder(little, 2)}) {
      const DecodedImage decoded = decode(message, 100);
      EXPECT_EQ(decoded.fault, "") << encoding << " " << int{message.is_bigendian};
      ASSERT_EQ(decoded.rgb.type(), CV_8UC3);
      ASSERT_EQ(decoded.rgb.cols, static_cast<int>(3 / channels));
      const std::vector<int> expected = {64, 64, 32};  // 0x4041 and 0x2030 are rounded
      for (int i = 0; i < 3; ++i) {
        const int pixel = channels == 3 ? 0 : i;
        EXPECT_EQ(decoded.rgb.at<cv::Vec3b>(0, pixel)[channels == 3 ? i : 0], expected[i])
            << encoding << " " << int{message.is_bigendian};
      }
    }
  }
}

/// A mosaic of numbers that differ from place to place, `bytes` each.
sensor_msgs::Image mosaicOf(const std::string& encoding, std::uint32_t bytes) {
  sensor_msgs::Image message;
  message.encoding = encoding;
  message.width = 12;
  message.height = 8;
  message.step = message.width * bytes;
  for (std::uint32_t i = 0; i < message.step * message.height; ++i)
    message.data.push_back(static_cast<std::uint8_t>(7 + 37 * i));
  return message;
}

/// As compressed_image_transport sends it.
sensor_msgs::CompressedImage compressedOf(const sensor_msgs::Image& raw, const std::string& kind) {
  sensor_msgs::CompressedImage message;
  message.format = raw.encoding + "; " + kind + " compressed ";
  cv::imencode("." + kind, cv_bridge::toCvCopy(raw)->image, message.data);
  return message;
}

TEST(Messages, CompressedMosaicsAreThePicturesThatTheRawOnesAre) {
  for (const auto& [encoding, bytes] :
       {std::pair<const char*, std::uint32_t>{"bayer_rggb8", 1}, {"bayer_gbrg8", 1}, {"bayer_bggr16", 2}}) {
    const sensor_msgs::Image raw = mosaicOf(encoding, bytes);
    const DecodedImage expected = decode(raw, 100), decoded = decode(compressedOf(raw, "png"), 100);
    ASSERT_EQ(expected.fault, "");
    ASSERT_EQ(decoded.fault, "") << encoding;
    ASSERT_EQ(decoded.rgb.type(), CV_8UC3);
    EXPECT_EQ(cv::norm(decoded.rgb, expected.rgb, cv::NORM_INF), 0.0) << encoding;
  }
}

/// A flat colour, whose mosaic is coarse: what JPEG loses of it is little beside that between the channels.
TEST(Messages, MosaicsInJpegHaveTheirColours) {
  sensor_msgs::Image raw = mosaicOf("bayer_rggb8", 1);
  for (std::uint32_t y = 0; y < raw.height; ++y)
    for (std::uint32_t x = 0; x < raw.width; ++x)
      raw.data[y * raw.step + x] = y % 2 == 0 && x % 2 == 0 ? 200 : y % 2 == 1 && x % 2 == 1 ? 40 : 100;
  const DecodedImage decoded = decode(compressedOf(raw, "jpeg"), 100);
  ASSERT_EQ(decoded.fault, "");
  EXPECT_TRUE(decoded.traits.is_lossy);
  const cv::Scalar mean = cv::mean(decoded.rgb);
  EXPECT_NEAR(mean[0], 200.0, 10.0);
  EXPECT_NEAR(mean[1], 100.0, 10.0);
  EXPECT_NEAR(mean[2], 40.0, 10.0);
}

TEST(Messages, ThatSpeakOfAMosaicButHoldAnotherPictureAreFaults) {
  sensor_msgs::CompressedImage message = *toPngMessage(image::Rgb8Image(4, 2), kHeader);
  message.format = "bayer_rggb8; png compressed bgr8";
  EXPECT_EQ(decode(message, 100).fault,
            "format \"bayer_rggb8; png compressed bgr8\": the data are of type CV_8UC3, but bayer_rggb8 is "
            "CV_8UC1");
  message = compressedOf(mosaicOf("bayer_rggb8", 1), "png");
  message.format = "bayer_rggb16; png compressed ";
  EXPECT_NE(decode(message, 100).fault, "");
}

TEST(Messages, ImagesOfOneChannelAreGrey) {
  const sensor_msgs::Image grey = imageOf("mono8", 1, {"\x01"}),
                           colour = imageOf("rgb8", 3, {"\x01", "\x01", "\x01"});
  for (const auto& [message, is_grey] : {std::pair{grey, true}, {colour, false}}) {
    EXPECT_EQ(decode(message, 100).traits.is_grey, is_grey);
    EXPECT_EQ(decode(compressedOf(message, "png"), 100).traits.is_grey, is_grey);
  }
  const sensor_msgs::Image mosaic = mosaicOf("bayer_rggb8", 1);
  EXPECT_FALSE(decode(mosaic, 100).traits.is_grey);
  EXPECT_FALSE(decode(compressedOf(mosaic, "png"), 100).traits.is_grey);
}

TEST(Messages, ImagesOf8BitHaveNoOrderOfBytes) {
  sensor_msgs::Image message = imageOf("rgb8", 3, {"\x01", "\x02", "\x03"});
  message.is_bigendian = 1;
  const DecodedImage decoded = decode(message, 100);
  ASSERT_EQ(decoded.fault, "");
  EXPECT_EQ(decoded.rgb.at<cv::Vec3b>(0, 0), cv::Vec3b(1, 2, 3));
}

/// 0x0102 mm, and 0x3fc00000, which is 1.5.
TEST(Messages, DepthIsReadInEitherOrderOfBytes) {
  using namespace std::string_literals;
  const sensor_msgs::Image millimetres = imageOf("16UC1", 1, {"\x02\x01"});
  const sensor_msgs::Image metres = imageOf("32FC1", 1, {"\0\0\xc0\x3f"s});
  for (const auto& [message, expected] : {std::pair{millimetres, 0.258f},
                                          {inOtherOrder(millimetres, 2), 0.258f},
                                          {metres, 1.5f},
                                          {inOtherOrder(metres, 4), 1.5f}}) {
    const DecodedDepth decoded = decodeDepth(message, 100);
    ASSERT_EQ(decoded.fault, "") << message.encoding;
    ASSERT_EQ(decoded.metres.type(), CV_32FC1) << message.encoding << " " << int{message.is_bigendian};
    EXPECT_FLOAT_EQ(decoded.metres.at<float>(0, 0), expected);
  }
}

TEST(Messages, CameraInfoOfRectifiedPicturesIsItsP) {
  sensor_msgs::CameraInfo info = toCameraInfo(
      image::calibrationOf(image::PinholeCamera::fromFieldOfView(640, 480, Angle::degrees(60.0))), kHeader);
  info.distortion_model = "plumb_bob";
  info.D = {-0.3, 0.1, 0.0, 0.0, 0.0};
  info.P = {400.0, 0.0, 310.0, 0.0, 0.0, 410.0, 230.0, 0.0, 0.0, 0.0, 1.0, 0.0};
  for (const char* topic : {"/rgb/image_rect_color", "/rgb/image_rect/compressed", "image_rect"}) {
    const image::Calibration read = fromCameraInfo(info, topic);
    EXPECT_EQ((std::vector<double>{read.camera.fx, read.camera.fy, read.camera.cx, read.camera.cy}),
              (std::vector<double>{400.0, 410.0, 310.0, 230.0}))
        << topic;
    EXPECT_TRUE(read.distortion.none()) << topic;
  }
  for (const char* topic : {"/rgb/image_raw", "/image_rectangle", ""}) {
    const image::Calibration read = fromCameraInfo(info, topic);
    EXPECT_EQ(read.camera.fx, info.K[0]) << topic;
    EXPECT_EQ(read.distortion.coefficients, info.D) << topic;
  }
  info.P[0] = 0.0;
  EXPECT_EQ(messageOf([&] { fromCameraInfo(info, "/image_rect"); }),
            "camera_info has no P, but pictures of /image_rect are rectified");
}

TEST(Messages, CoefficientsOfNoModelAreNoneWhereTheyAreZeros) {
  sensor_msgs::CameraInfo info = toCameraInfo(
      image::calibrationOf(image::PinholeCamera::fromFieldOfView(640, 480, Angle::degrees(60.0))), kHeader);
  info.distortion_model.clear();
  info.D.assign(5, 0.0);
  EXPECT_TRUE(fromCameraInfo(info, "/rgb/image_raw").distortion.none());
  info.D[1] = 0.1;
  EXPECT_NE(messageOf([&] { fromCameraInfo(info, "/rgb/image_raw"); }).find("distortion_model"),
            std::string::npos);
}

TEST(Messages, CameraInfoProjectsLikeTheCamera) {
  const auto camera = image::PinholeCamera::fromFieldOfView(64, 48, Angle::degrees(90.0));
  const sensor_msgs::CameraInfo info = toCameraInfo(image::calibrationOf(camera), kHeader);
  const Eigen::Vector3d point(0.3, -0.2, 2.0);
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> k(info.K.data());
  const Eigen::Vector2d pixel = (k * point).hnormalized();
  // Both are a few roundings of a double.
  EXPECT_LT((pixel - camera.project(point)).norm(), 1e-12);
  EXPECT_EQ(info.D, std::vector<double>(5, 0.0));
}

TEST(Messages, PosesSurviveTheWayThereAndBack) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  pose.translation() = Eigen::Vector3d(1, -2, 3);
  EXPECT_LT((fromPose(toPose(pose)).matrix() - pose.matrix()).norm(), 1e-12);  // rounding
}

TEST(Messages, RefuseWhatIsNoPose) {
  geometry_msgs::Pose pose;
  EXPECT_THROW(fromPose(pose), std::invalid_argument);  // a quaternion of zeros
  pose.orientation.w = 1.0;
  EXPECT_NO_THROW(fromPose(pose));
  pose.position.y = std::numeric_limits<double>::infinity();
  EXPECT_THROW(fromPose(pose), std::invalid_argument);
}

SunPosition sunMessage() {
  SunPosition message;
  message.header.frame_id = "map";
  message.distance_au = 1.0;
  message.direction.z = 1.0;
  message.elevation_geometric = 1.5;
  return message;
}

MoonPosition moonMessage() {
  MoonPosition message;
  message.header.frame_id = "map";
  message.distance = 3.844e8;
  message.direction.y = 1.0;
  message.elevation_geometric = -0.01;
  message.phase_angle = 2.0;
  return message;
}

geometry_msgs::QuaternionStamped celestialMessage() {
  geometry_msgs::QuaternionStamped message;
  message.header.frame_id = "map";
  message.quaternion.w = message.quaternion.x = std::sqrt(0.5);
  return message;
}

TEST(SkyMessages, AreWhatTheySay) {
  const sky::MoonInSky moon = fromMessage(moonMessage(), "map");
  EXPECT_EQ(moon.apparent.vector(), Eigen::Vector3d::UnitY());
  EXPECT_NEAR(moon.geometric->elevation().rad(), -0.01, 1e-15);  // rounding
  EXPECT_NEAR(moon.geometric->azimuth().rad(), 0.0, 1e-15);
  EXPECT_EQ(moon.distance_m, 3.844e8);
  EXPECT_EQ(moon.phase_angle.rad(), 2.0);
  // A quarter turn about x takes y to z.
  EXPECT_LT(
      (fromMessage(celestialMessage(), "map") * Eigen::Vector3d::UnitY() - Eigen::Vector3d::UnitZ()).norm(),
      1e-15);
  EXPECT_NEAR(fromMessage(sunMessage(), "map").geometric->elevation().rad(), 1.5, 1e-8);  // asin near its end
}

TEST(SkyMessages, TellOfAnEclipseAsTheSkyDoesThatTheyCameFrom) {
  // Over Dallas, in a crescent that is gone a minute later.
  const Instant instant = astronomy::midnightOf({2024, 4, 8, 0.0}).plusSeconds(18 * 3600 + 39 * 60 + 43);
  const Site site{Angle::degrees(32.78), Angle::degrees(-96.80), 130.0};
  ComputedSun sun{instant, astronomy::solarCoordinates(instant, {}), {}, site.elevation_m};
  sun.position = astronomy::sunPosition(sun.coordinates, site, {});
  const ComputedMoon moon{instant, astronomy::moonPosition(instant, {}, site, {})};
  std_msgs::Header header;
  header.frame_id = "map";
  const sky::Overlap told = sky::sunBehindMoon(fromMessage(toMessage(sun, header), "map"),
                                               fromMessage(toMessage(moon, header), "map"));
  const sky::Overlap is = sky::sunBehindMoon(
      {sun.position.direction(), sun.coordinates.distance_au,
       Direction(sun.position.azimuth, sun.position.elevation_geometric)},
      {moon.position.direction(), moon.position.geometricDirection(), moon.position.distance_m, Angle()});
  EXPECT_NEAR(told.apart.rad(), is.apart.rad(), 1e-12);  // 1e-7 of the sun's width
  EXPECT_EQ(told.cover_radius.rad(), is.cover_radius.rad());
  EXPECT_EQ(told.radius.rad(), is.radius.rad());
  EXPECT_GT(sky::uncoveredArea(told), 0.0);
  EXPECT_LT(sky::uncoveredArea(told), 0.02);
}

template <typename Message>
std::string refusal(const Message& message) {
  return messageOf([&] { fromMessage(message, "map"); });
}

TEST(SkyMessages, ThatCannotBeAreRefusedInWords) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(moonMessage()), "");
  MoonPosition moon = moonMessage();
  moon.header.frame_id = "base_link";
  EXPECT_EQ(refusal(moon), "frame_id is \"base_link\", but must be \"map\"");
  moon = moonMessage();
  moon.direction.x = 1.0;
  EXPECT_EQ(refusal(moon), "direction is of length 1.414213562, but must be of length 1");
  moon = moonMessage();
  moon.distance = nan;
  EXPECT_EQ(refusal(moon), "distance is nan, but must be from 340000000 to 420000000 m");
  moon = moonMessage();
  moon.phase_angle = -0.1;
  EXPECT_EQ(refusal(moon), "phase_angle is -0.1, but must be from 0 to 3.141592654 rad");
  moon = moonMessage();
  moon.elevation_geometric = 2.0;
  EXPECT_EQ(refusal(moon), "elevation_geometric is 2, but must be from -1.570796327 to 1.570796327 rad");
  SunPosition sun = sunMessage();
  sun.distance_au = 0.5;
  EXPECT_EQ(refusal(sun), "distance_au is 0.5, but must be from 0.97 to 1.03 au");
  sun = sunMessage();
  sun.elevation_geometric = 0.0;  // as it is where nobody set it
  EXPECT_EQ(refusal(sun),
            "elevation_geometric is 0 rad, but must be within 5 deg of that of direction, 1.570796327 rad");
  for (const double rate : {nan, std::numeric_limits<double>::infinity()}) {
    sun = sunMessage();
    sun.rate = rate;
    EXPECT_EQ(refusal(sun), "rate is " + textOf(rate) + ", but must be a finite number");
  }
  geometry_msgs::QuaternionStamped celestial = celestialMessage();
  celestial.quaternion.w = nan;
  EXPECT_EQ(refusal(celestial), "quaternion is of length nan, but must be of length 1");
}

TEST(CivilTime, ReadsAsIsoSays) {
  const Instant instant = astronomy::instantOf({2024, 7, 1, 4, 30, 7.25, 3.0});
  EXPECT_EQ(toUtc(instant), "2024-07-01T01:30:07.250Z");
  EXPECT_EQ(toUtc(instant.plusSeconds(52.7496)), "2024-07-01T01:31:00.000Z");  // rounded, and carried
  EXPECT_EQ(toUtc(astronomy::instantOf({-1999, 3, 2, 0, 0, 0.0, 0.0})), "-1999-03-02T00:00:00.000Z");
  EXPECT_EQ(toUtc(astronomy::instantOf({0, 3, 2, 0, 0, 0.0, 0.0})), "0000-03-02T00:00:00.000Z");
}

TEST(CivilTime, InWordsIsRoundedAndCarried) {
  const auto text = [](const CivilDateTime& civil) {
    return textOfDate(astronomy::instantOf(civil), civil.timezone);
  };
  EXPECT_EQ(text({2024, 7, 1, 4, 30, 7.25, 3.0}), "2024-07-01 04:30:07.250 UTC+03:00");
  EXPECT_EQ(text({2024, 7, 1, 12, 0, 59.9996, 3.0}), "2024-07-01 12:01:00.000 UTC+03:00");
  EXPECT_EQ(text({2024, 12, 31, 23, 59, 59.9999, -3.5}), "2025-01-01 00:00:00.000 UTC-03:30");
  // A zone of no whole milliseconds.
  EXPECT_EQ(text({2024, 7, 1, 12, 0, 59.9999, 3.3333333}), "2024-07-01 12:01:00.000 UTC+03:20");
  EXPECT_EQ(text({-1000, 7, 1, 12, 0, 59.9994, 0.0}), "-1000-07-01 12:00:59.999 UTC+00:00");
}

TEST(CivilTime, SurvivesTheWayThereAndBackInAllYears) {
  EXPECT_FALSE(fromUtc(""));
  for (int year = -2000; year <= 6000; year += 7) {
    const Instant instant = astronomy::instantOf({year, 11, 30, 23, 59, 59.999, 0.0});
    ASSERT_EQ(fromUtc(toUtc(instant)), instant) << toUtc(instant);
  }
}

TEST(CivilTime, OfTheFirstAndLastDaysOfAllTimeZonesIsUnderstood) {
  for (const CivilDateTime& civil :
       {CivilDateTime{6000, 12, 31, 22, 0, 0.25, -5.0}, CivilDateTime{6000, 12, 31, 23, 59, 59.999, -18.0},
        CivilDateTime{-2000, 1, 1, 0, 0, 0.0, 18.0}, CivilDateTime{-2000, 1, 1, 2, 59, 59.0, 3.0}}) {
    const Instant instant = astronomy::instantOf(civil);
    EXPECT_EQ(messageOf([&] { fromUtc(toUtc(instant)); }), "");
    EXPECT_EQ(fromUtc(toUtc(instant)), instant) << toUtc(instant);
  }
  for (const char* beyond : {"6001-01-02T00:00:00.000Z", "-2001-12-30T23:00:00.000Z"})
    EXPECT_NE(messageOf([&] { fromUtc(beyond); }).find("year is "), std::string::npos) << beyond;
}

TEST(CivilTime, ThatCannotBeIsRefusedInWords) {
  for (const char* bad : {"noon", "2024-07-01", "2024-07-01T01:30:07.250", "2024-07-01T01:30:07.250Z "}) {
    EXPECT_EQ(messageOf([&] { fromUtc(bad); }),
              "utc is \"" + std::string(bad) + "\", but must read like 2024-07-01T09:00:00.000Z");
  }
  EXPECT_NE(messageOf([&] { fromUtc("2024-02-31T01:30:07.250Z"); }).find("day is 31"), std::string::npos);
}

/// How many images are missing of one sender.
std::uint32_t missingOf(const std::vector<std::uint32_t>& numbers) {
  SequenceGaps gaps;
  std::uint32_t missing = 0;
  for (const std::uint32_t number : numbers) missing += gaps.add(number, 0).images;
  return missing;
}

TEST(SequenceGaps, AreWhatIsMissingOfNumbersThatGoUpOneByOne) {
  EXPECT_EQ(missingOf({7, 8, 9, 10}), 0u);
  EXPECT_EQ(missingOf({7, 8, 12, 13}), 3u);
  EXPECT_EQ(missingOf({7, 11, 12, 13}), 3u) << "before any step is known";
  EXPECT_EQ(missingOf({7, 8, 12, 13, 0, 1, 3}), 4u) << "a sender that began anew";
  EXPECT_EQ(missingOf({7, 7, 8}), 0u);
}

TEST(SequenceGaps, ASteadyStepIsNoLoss) {
  EXPECT_EQ(missingOf({0, 10, 20, 30}), 0u);
  EXPECT_EQ(missingOf({0, 10, 19, 30, 41}), 0u) << "as a throttle goes by time";
  EXPECT_EQ(missingOf({0, 10, 20, 50}), 2u);
}

TEST(SequenceGaps, HaveTheStampOfTheImageBehindThem) {
  SequenceGaps gaps;
  gaps.add(1, 100);
  gaps.add(4, 200);
  EXPECT_EQ(gaps.add(5, 300).stamp_ns, 200) << "known one later";
  EXPECT_EQ(gaps.add(8, 400).stamp_ns, 400);
}

}  // namespace
}  // namespace sunlit::ros_interface
