#include "ros/evaluator/image_conversion.h"

#include <sensor_msgs/image_encodings.h>

#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

#include "sunlit/quantity/angle.h"

namespace sunlit::ros_interface {
namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1000000000;
constexpr int kCopy = -1;  // pixels are what we want already

struct Encoding {
  int type;        // of OpenCV
  int conversion;  // cv::ColorConversionCodes
};

const std::map<std::string, Encoding>& knownEncodings() {
  namespace names = sensor_msgs::image_encodings;
  static const std::map<std::string, Encoding> known = {{names::RGB8, {CV_8UC3, kCopy}},
                                                        {names::BGR8, {CV_8UC3, cv::COLOR_BGR2RGB}},
                                                        {names::MONO8, {CV_8UC1, cv::COLOR_GRAY2RGB}},
                                                        {names::RGBA8, {CV_8UC4, cv::COLOR_RGBA2RGB}},
                                                        {names::BGRA8, {CV_8UC4, cv::COLOR_BGRA2RGB}}};
  return known;
}

}  // namespace

std::int64_t nanosecondsOf(const ros::Time& time) {
  return static_cast<std::int64_t>(time.sec) * kNanosecondsPerSecond + time.nsec;
}

ros::Time timeOf(std::int64_t nanoseconds) {
  return ros::Time(static_cast<std::uint32_t>(nanoseconds / kNanosecondsPerSecond),
                   static_cast<std::uint32_t>(nanoseconds % kNanosecondsPerSecond));
}

DecodedImage decode(const sensor_msgs::Image& message) {
  DecodedImage decoded;
  const auto found = knownEncodings().find(message.encoding);
  if (found == knownEncodings().end()) {
    decoded.fault = "encoding \"" + message.encoding + "\" is not one of rgb8, bgr8, mono8, rgba8, bgra8";
    return decoded;
  }
  const Encoding& encoding = found->second;
  const std::size_t row_bytes = static_cast<std::size_t>(message.width) * CV_ELEM_SIZE(encoding.type);
  const std::size_t bytes = static_cast<std::size_t>(message.step) * message.height;
  if (message.width == 0 || message.height == 0) {
    decoded.fault = "has no pixels";
  } else if (message.step < row_bytes) {
    decoded.fault =
        "step " + std::to_string(message.step) + " is less than a row of " + std::to_string(row_bytes);
  } else if (message.data.size() != bytes) {
    decoded.fault = std::to_string(message.data.size()) + " bytes instead of " + std::to_string(bytes);
  }
  if (!decoded.fault.empty()) return decoded;
  const cv::Mat pixels(static_cast<int>(message.height), static_cast<int>(message.width), encoding.type,
                       const_cast<std::uint8_t*>(message.data.data()), message.step);
  if (encoding.conversion == kCopy) {
    decoded.rgb = pixels.clone();
  } else {
    cv::cvtColor(pixels, decoded.rgb, encoding.conversion);
  }
  return decoded;
}

evaluate::CaptureRecord captureOf(const Capture& message) {
  evaluate::CaptureRecord record;
  record.pose = message.pose_index;
  record.stamp_ns = nanosecondsOf(message.header.stamp);
  record.ev100 = message.ev100;
  record.sun_azimuth_deg = message.sun_azimuth / kRadPerDeg;
  record.sun_elevation_deg = message.sun_elevation / kRadPerDeg;
  record.moon_azimuth_deg = message.moon_azimuth / kRadPerDeg;
  record.moon_elevation_deg = message.moon_elevation / kRadPerDeg;
  record.moon_illuminated_fraction = message.moon_illuminated_fraction;
  record.scene_illuminance_lx = message.scene_illuminance;
  return record;
}

evaluate::PlaceRecord placeOf(const geometry_msgs::PoseStamped& message) {
  const auto& q = message.pose.orientation;
  evaluate::PlaceRecord record;
  record.stamp_ns = nanosecondsOf(message.header.stamp);
  record.x_m = message.pose.position.x;
  record.y_m = message.pose.position.y;
  record.z_m = message.pose.position.z;
  record.yaw_deg =
      std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z)) / kRadPerDeg;
  return record;
}

PairDifference messageOf(const evaluate::EvaluationOptions& options, const evaluate::PairRecord& record) {
  PairDifference message;
  message.header.stamp = timeOf(record.stamp_ns);
  message.pose = static_cast<std::uint32_t>(record.pose);
  message.a = options.pairs.at(record.pair).a;
  message.b = options.pairs.at(record.pair).b;
  for (std::size_t d = 0; d < record.values.size(); ++d) {
    const evaluate::DifferenceValue& value = record.values[d];
    Difference difference;
    difference.difference = evaluate::nameOf(options.comparer.differences.at(d));
    difference.value = value.value;
    difference.features_a = value.features_a;
    difference.features_b = value.features_b;
    difference.matches = value.matches;
    difference.zero_second = value.zero_second;
    message.differences.push_back(difference);
  }
  return message;
}

sensor_msgs::Image messageOf(const cv::Mat& rgb, const std_msgs::Header& header) {
  sensor_msgs::Image message;
  message.header = header;
  message.encoding = sensor_msgs::image_encodings::RGB8;
  message.width = static_cast<std::uint32_t>(rgb.cols);
  message.height = static_cast<std::uint32_t>(rgb.rows);
  message.step = static_cast<std::uint32_t>(rgb.cols * rgb.elemSize());
  const cv::Mat whole = rgb.isContinuous() ? rgb : rgb.clone();
  message.data.assign(whole.data, whole.data + whole.total() * whole.elemSize());
  return message;
}

Summary messageOf(const std::vector<evaluate::SummaryRow>& rows, std::size_t poses) {
  Summary message;
  message.poses = static_cast<std::uint32_t>(poses);
  for (const evaluate::SummaryRow& row : rows) {
    SummaryRow out;
    out.a = row.a;
    out.b = row.b;
    out.difference = evaluate::nameOf(row.difference);
    out.n = static_cast<std::uint32_t>(row.statistics.n);
    out.undefined = static_cast<std::uint32_t>(row.statistics.undefined);
    out.mean = row.statistics.mean;
    out.sd = row.statistics.sd;
    out.ci_low = row.statistics.ci_low;
    out.ci_high = row.statistics.ci_high;
    message.rows.push_back(out);
  }
  return message;
}

}  // namespace sunlit::ros_interface
