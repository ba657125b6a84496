#include "ros/conversions/encodings.h"

#include <sensor_msgs/image_encodings.h>

#include <opencv2/core.hpp>
#include <optional>

#include "ros/conversions/encodings_by_cv_bridge.h"
#include "sunlit/quantity/late_library.h"

namespace sunlit::ros_interface {
namespace {

const Encodings& encodings() {
  static const Encodings& loaded =
      *functionIn<decltype(sunlitEncodings)>("libsunlit_encodings.so", "sunlitEncodings")();
  return loaded;
}

/// Of what is sent most.
std::optional<int> knownType(const std::string& encoding) {
  namespace encodings = sensor_msgs::image_encodings;
  if (encoding == encodings::RGB8) return CV_8UC3;
  if (encoding == encodings::TYPE_32FC1) return CV_32FC1;
  if (encoding == encodings::TYPE_16UC1) return CV_16UC1;
  return std::nullopt;
}

}  // namespace

int typeOf(const std::string& encoding) {
  if (const std::optional<int> type = knownType(encoding)) return *type;
  return encodings().type_of(encoding);
}

cv::Mat pixelsOf(const sensor_msgs::Image& message, const std::string& encoding) {
  const std::optional<int> type = knownType(encoding);
  if (!type || message.encoding != encoding) return encodings().pixels_of(message, encoding);
  const cv::Mat pixels(static_cast<int>(message.height), static_cast<int>(message.width), *type,
                       const_cast<std::uint8_t*>(message.data.data()), message.step);
  return pixels.clone();
}

cv::Mat recoded(const cv::Mat& pixels, const std::string& from, const std::string& to) {
  return encodings().recode(pixels, from, to);
}

}  // namespace sunlit::ros_interface
