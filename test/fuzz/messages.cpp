// Messages and requests of topics and services as they come over the wire: a first letter that tells of what
// type, then its bytes.
#include <ros/serialization.h>
#include <sensor_msgs/image_encodings.h>
#include <sys/resource.h>

#include "fuzz/reader.h"
#include "ros/conversions/geometry.h"
#include "ros/conversions/images.h"
#include "ros/conversions/received_images.h"
#include "ros/conversions/requests.h"
#include "ros/sun_position/answers.h"

namespace sunlit::fuzz {
namespace {

using namespace ros_interface;

constexpr std::size_t kMostPixels = 1 << 20;

template <typename Message>
std::string wire(char letter, const Message& message) {
  std::string bytes(ros::serialization::serializationLength(message), '\0');
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(bytes.data()),
                                     static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return letter + bytes;
}

template <typename Message>
Message heard(const std::string& input) {
  std::string bytes = input.substr(1);
  ros::serialization::IStream stream(reinterpret_cast<std::uint8_t*>(bytes.data()),
                                     static_cast<std::uint32_t>(bytes.size()));
  Message message;
  try {
    ros::serialization::deserialize(stream, message);
  } catch (
      const std::bad_alloc&) {  // roscpp makes room for what a length says before it looks; it catches this
    throw std::runtime_error("a length is beyond all memory");
  }
  return message;
}

sensor_msgs::Image imageOf(const std::string& encoding, std::uint32_t bytes_a_pixel) {
  sensor_msgs::Image message;
  message.encoding = encoding;
  message.width = 4;
  message.height = 2;
  message.step = 4 * bytes_a_pixel;
  message.data.assign(message.step * message.height, 77);
  return message;
}

template <typename Request>
Request plausible() {
  Request request;
  request.year = 2024;
  request.month = 7;
  request.day = 1;
  request.timezone = 3.0;
  request.latitude = 55.0;
  request.longitude = 49.0;
  request.elevation = 90.0;
  return request;
}

}  // namespace

std::vector<std::string> seeds() {
  namespace encodings = sensor_msgs::image_encodings;
  sensor_msgs::CompressedImage png;
  png.format = "png";
  png.data = toPngMessage(image::Rgb8Image(3, 2), {})->data;
  geometry_msgs::Pose pose;
  pose.orientation.w = 1.0;
  auto sun = plausible<GetSunPosition::Request>();
  sun.hour = 12;
  sun.pressure = 1013.0;
  sun.temperature = 10.0;
  auto moon = plausible<GetMoonPosition::Request>();
  moon.pressure = 1013.0;
  SetDateTime::Request set;
  set.year = 2024;
  set.month = set.day = 1;
  return {wire('i', imageOf(encodings::RGB8, 3)),
          wire('i', imageOf(encodings::MONO16, 2)),
          wire('i', imageOf(encodings::BAYER_RGGB8, 1)),
          wire('i', imageOf(encodings::YUV422, 2)),
          wire('i', imageOf(encodings::BGRA8, 4)),
          wire('d', imageOf(encodings::TYPE_32FC1, 4)),
          wire('d', imageOf(encodings::TYPE_16UC1, 2)),
          wire('c', png),
          wire('k', toCameraInfo(image::calibrationOf(
                                     image::PinholeCamera::fromFieldOfView(64, 48, Angle::degrees(60.0))),
                                 {})),
          wire('p', pose),
          wire('s', sun),
          wire('m', moon),
          wire('t', plausible<GetSunTimes::Request>()),
          wire('S', set)};
}

void read(const std::string& input) {
#ifndef SUNLIT_FUZZ
  // So that roscpp is refused at once what a length of 2 GB says, instead of filling it with zeros.
  static const rlimit kMemory{rlim_t{1} << 30, rlim_t{1} << 30};
  static const int limited = ::setrlimit(RLIMIT_AS, &kMemory);
  static_cast<void>(limited);
#endif
  switch (input.empty() ? '\0' : input[0]) {
    case 'i':
      decode(heard<sensor_msgs::Image>(input), kMostPixels);
      break;
    case 'd':
      decodeDepth(heard<sensor_msgs::Image>(input), kMostPixels);
      break;
    case 'c':
      decode(heard<sensor_msgs::CompressedImage>(input), kMostPixels);
      break;
    case 'k':
      fromCameraInfo(heard<sensor_msgs::CameraInfo>(input));
      break;
    case 'p':
      fromPose(heard<geometry_msgs::Pose>(input));
      break;
    case 's': {
      GetSunPosition::Response response;
      answer(heard<GetSunPosition::Request>(input), {}, &response);
      break;
    }
    case 'm': {
      GetMoonPosition::Response response;
      answer(heard<GetMoonPosition::Request>(input), {}, &response);
      break;
    }
    case 't': {
      GetSunTimes::Response response;
      answer(heard<GetSunTimes::Request>(input), {}, {}, &response);
      break;
    }
    case 'S':
      dateTimeOf(heard<SetDateTime::Request>(input));
      break;
    default:
      break;
  }
}

std::string named() {
  return "";  // each of them names the field
}

}  // namespace sunlit::fuzz
