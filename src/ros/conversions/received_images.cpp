#include "ros/conversions/received_images.h"

#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>

#include "ros/conversions/encodings.h"
#include "sunlit/image/codecs.h"
#include "sunlit/image/encoded_size.h"

namespace sunlit::ros_interface {
namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1000000000;

// Products of two 32-bit numbers fit 64 bits, however absurd they are.
std::string faultOfSize(std::uint64_t width, std::uint64_t height, std::size_t max_pixels) {
  if (width == 0 || height == 0) return "has no pixels";
  if (width * height <= max_pixels) return "";
  return std::to_string(width) + "x" + std::to_string(height) + " pixels are more than max_pixels (" +
         std::to_string(max_pixels) + ")";
}

std::string faultOfData(const sensor_msgs::Image& message) {
  const int type = typeOf(message.encoding);
  const std::uint64_t row_bytes = static_cast<std::uint64_t>(message.width) * CV_ELEM_SIZE(type);
  const std::uint64_t bytes = static_cast<std::uint64_t>(message.step) * message.height;
  if (message.step < row_bytes)
    return "step " + std::to_string(message.step) + " is less than a row of " + std::to_string(row_bytes) +
           ": " + std::to_string(message.width) + " pixels of " + message.encoding;
  if (message.step % CV_ELEM_SIZE1(type) != 0)
    return "step " + std::to_string(message.step) + " is no multiple of the " +
           std::to_string(CV_ELEM_SIZE1(type)) + " bytes of a number of " + message.encoding;
  if (message.data.size() != bytes)
    return std::to_string(message.data.size()) + " bytes instead of " + std::to_string(bytes);
  return "";
}

/// What cv_bridge makes of it. Of numbers in the other order of bytes it makes 8-bit channels, one a byte, so
/// they are swapped before. Throws what it and OpenCV throw.
cv::Mat numbersOf(const sensor_msgs::Image& message, const std::string& encoding) {
  constexpr bool kIsBigEndian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
  const std::size_t bytes = CV_ELEM_SIZE1(typeOf(message.encoding));
  if (bytes == 1 || (message.is_bigendian != 0) == kIsBigEndian) return pixelsOf(message, encoding);
  sensor_msgs::Image swapped = message;
  swapped.is_bigendian = kIsBigEndian;
  // Rows begin with a number, as faultOfData() requires.
  for (std::size_t i = 0; i + bytes <= swapped.data.size(); i += bytes)
    std::reverse(&swapped.data[i], &swapped.data[i] + bytes);
  return pixelsOf(swapped, encoding);
}

bool tellsColours(const std::string& encoding) {
  namespace encodings = sensor_msgs::image_encodings;
  return encodings::isColor(encoding) || encodings::isMono(encoding) || encodings::isBayer(encoding) ||
         encoding.rfind("yuv", 0) == 0;
}

/// What the camera called it, where compressed_image_transport sent it: its formats read like "rgb8; jpeg
/// compressed bgr8".
std::string encodingIn(const std::string& format) {
  return format.substr(0, format.find(';'));
}

cv::Mat decoded(const sensor_msgs::CompressedImage& message, int flags) {
  return image::decodePicture(message.data.data(), message.data.size(), flags);
}

/// A Bayer mosaic is compressed as it is, in one channel. Throws what cv_bridge and OpenCV throw, and
/// std::runtime_error for what is no such mosaic.
cv::Mat mosaicOf(const sensor_msgs::CompressedImage& message) {
  const std::string encoding = encodingIn(message.format);
  const cv::Mat mosaic = decoded(message, cv::IMREAD_UNCHANGED);
  if (mosaic.empty()) return {};
  const int type = typeOf(encoding);
  if (mosaic.type() != type)
    throw std::runtime_error("the data are of type " + cv::typeToString(mosaic.type()) + ", but " + encoding +
                             " is " + cv::typeToString(type));
  return recoded(mosaic, encoding, sensor_msgs::image_encodings::RGB8);
}

/// Throws what OpenCV throws.
cv::Mat pictureOf(const sensor_msgs::CompressedImage& message) {
  cv::Mat bgr = decoded(message, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION);
  if (bgr.depth() == CV_16U) bgr.convertTo(bgr, CV_8U, 255.0 / 65535.0);
  cv::Mat rgb;
  if (!bgr.empty()) cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  return rgb;
}

/// Depth that no camera measures is none, as what lies nowhere. A fault where most of it is such, of the
/// other order of bytes; and where it is of whole numbers beyond 100 m: millimetres, which nobody should
/// measure a drive by.
std::string faultOfDepth(cv::Mat& metres) {
  constexpr float kLeast = 1e-3F, kMost = 1e6F, kBeyond = 100.0F;
  std::size_t measured = 0, nonsense = 0;
  float worst = 0.0F, nearest = kMost, farthest = 0.0F;
  bool are_whole = true;
  for (int row = 0; row < metres.rows; ++row) {
    for (float *z = metres.ptr<float>(row), *end = z + metres.cols; z != end; ++z) {
      const bool is_told = *z > 0.0F && *z < std::numeric_limits<float>::max();  // some send that for nothing
      if (!is_told) continue;
      ++measured;
      if (*z >= kLeast && *z <= kMost) {
        are_whole = are_whole && *z == std::trunc(*z);
        nearest = std::min(nearest, *z);
        farthest = std::max(farthest, *z);
        continue;
      }
      ++nonsense;
      worst = *z;
      *z = std::numeric_limits<float>::quiet_NaN();
    }
  }
  std::ostringstream fault;
  if (are_whole && nearest < farthest && farthest > kBeyond) {
    fault << "depths from " << nearest << " to " << farthest
          << " m are whole numbers: 32FC1 must be metres; millimetres are of 16UC1";
    return fault.str();
  }
  if (2 * nonsense <= measured) return "";
  fault << nonsense << " of " << measured << " depths are not between " << kLeast << " and " << kMost
        << " m, as " << worst << ": 32FC1 must be metres, in the order of bytes that is_bigendian tells";
  return fault.str();
}

}  // namespace

std::int64_t nanosecondsOf(const ros::Time& time) {
  return static_cast<std::int64_t>(time.sec) * kNanosecondsPerSecond + time.nsec;
}

ros::Time timeOf(std::int64_t nanoseconds) {
  return ros::Time(static_cast<std::uint32_t>(nanoseconds / kNanosecondsPerSecond),
                   static_cast<std::uint32_t>(nanoseconds % kNanosecondsPerSecond));
}

DecodedImage decode(const sensor_msgs::Image& message, std::size_t max_pixels) {
  DecodedImage decoded;
  try {
    decoded.fault = faultOfSize(message.width, message.height, max_pixels);
    if (decoded.fault.empty()) decoded.fault = faultOfData(message);
    if (decoded.fault.empty()) decoded.rgb = numbersOf(message, sensor_msgs::image_encodings::RGB8);
    decoded.traits.is_grey = sensor_msgs::image_encodings::isMono(message.encoding);
  } catch (const std::exception& error) {  // of cv_bridge and of OpenCV
    decoded.fault =
        "encoding \"" + message.encoding + "\" cannot be converted to rgb8: " +
        (tellsColours(message.encoding)
             ? error.what()
             : "it tells numbers, not colours; mono8, rgb8, bgr8, rgba8, bgra8, those of 16 bits, "
               "Bayer mosaics and yuv422 can be");
  }
  return decoded;
}

DecodedImage decode(const sensor_msgs::CompressedImage& message, std::size_t max_pixels) {
  DecodedImage decoded;
  const auto head = image::encodedPicture(message.data.data(), message.data.size());
  if (!head) {
    decoded.fault =
        "format \"" + message.format + "\"" +
        (message.data.empty() ? ": there are no data" : " is neither PNG nor JPEG, or is cut short");
    return decoded;
  }
  decoded.traits.is_lossy = head->is_lossy;
  const bool is_mosaic = sensor_msgs::image_encodings::isBayer(encodingIn(message.format));
  decoded.traits.is_grey = head->is_grey && !is_mosaic;
  decoded.fault = faultOfSize(head->width, head->height, max_pixels);
  if (head->is_cut_short) decoded.fault = "format \"" + message.format + "\": the data are cut short";
  if (!decoded.fault.empty()) return decoded;
  try {
    if (head->is_lossy && image::isDamagedJpeg(message.data.data(), message.data.size()))
      throw std::runtime_error("damaged within");
    decoded.rgb = is_mosaic ? mosaicOf(message) : pictureOf(message);
    if (decoded.rgb.empty()) decoded.fault = "format \"" + message.format + "\": the data cannot be decoded";
  } catch (const std::exception& error) {  // of cv_bridge, of OpenCV and ours
    decoded.fault = "format \"" + message.format + "\": " + error.what();
  }
  return decoded;
}

DecodedDepth decodeDepth(const sensor_msgs::Image& message, std::size_t max_pixels) {
  namespace encodings = sensor_msgs::image_encodings;
  constexpr double kMetresPerMillimetre = 1e-3;
  DecodedDepth decoded;
  const bool is_metres = message.encoding == encodings::TYPE_32FC1;
  if (!is_metres && message.encoding != encodings::TYPE_16UC1) {
    decoded.fault = "depth has the encoding \"" + message.encoding + "\", but must have 32FC1 or 16UC1";
    return decoded;
  }
  decoded.fault = faultOfSize(message.width, message.height, max_pixels);
  if (decoded.fault.empty()) decoded.fault = faultOfData(message);
  if (!decoded.fault.empty()) return decoded;
  try {
    const cv::Mat numbers = numbersOf(message, message.encoding);
    if (is_metres) {
      decoded.metres = numbers;
      decoded.fault = faultOfDepth(decoded.metres);
      if (!decoded.fault.empty()) decoded.metres.release();
    } else {
      numbers.convertTo(decoded.metres, CV_32F, kMetresPerMillimetre);
    }
  } catch (const std::exception& error) {  // of cv_bridge and of OpenCV
    decoded.fault = "depth cannot be read: " + std::string(error.what());
  }
  return decoded;
}

}  // namespace sunlit::ros_interface
