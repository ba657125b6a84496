#include "ros/conversions/evaluation.h"

#include <sensor_msgs/image_encodings.h>

#include <cmath>
#include <stdexcept>

#include "ros/conversions/geometry.h"
#include "ros/conversions/images.h"
#include "ros/conversions/received_images.h"
#include "ros/conversions/time.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/ros/frame_names.h"

namespace sunlit::ros_interface {

evaluate::CaptureRecord captureOf(const Capture& message) {
  evaluate::CaptureRecord record;
  record.pose = message.pose_index;
  record.stamp_ns = nanosecondsOf(message.header.stamp);
  record.ev100 = message.ev100;
  record.exposure_mode = message.exposure_mode;
  record.sun_azimuth_deg = message.sun_azimuth / kRadPerDeg;
  record.sun_elevation_deg = message.sun_elevation / kRadPerDeg;
  record.moon_azimuth_deg = message.moon_azimuth / kRadPerDeg;
  record.moon_elevation_deg = message.moon_elevation / kRadPerDeg;
  record.moon_illuminated_fraction = message.moon_illuminated_fraction;
  record.scene_illuminance_lx = message.scene_illuminance;
  record.utc_text = message.utc;
  try {
    record.utc = fromUtc(message.utc);
  } catch (const std::invalid_argument&) {  // which the evaluation names
  }
  return record;
}

evaluate::PlaceRecord placeOf(const geometry_msgs::PoseStamped& message) {
  const auto& q = message.pose.orientation;
  evaluate::PlaceRecord record;
  record.stamp_ns = nanosecondsOf(message.header.stamp);
  record.x_m = message.pose.position.x;
  record.y_m = message.pose.position.y;
  record.z_m = message.pose.position.z;
  const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  record.yaw_deg =
      std::abs(length - 1.0) < kUnitLength
          ? std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z)) / kRadPerDeg
          : std::nan("");
  return record;
}

evaluate::Told<Eigen::Isometry3d> truePoseOf(const geometry_msgs::PoseStamped& message) {
  try {
    return evaluate::told(Eigen::Isometry3d(fromPose(message.pose) * linkFromOptical()));
  } catch (const std::invalid_argument& error) {
    return evaluate::unusable<Eigen::Isometry3d>(error.what());
  }
}

evaluate::Told<evaluate::ViewCamera> cameraOf(const sensor_msgs::CameraInfo& message,
                                              const std::string& topic) {
  try {
    const image::Calibration read = fromCameraInfo(message, topic);
    return evaluate::told(evaluate::ViewCamera(read.camera, read.distortion));
  } catch (const std::invalid_argument& error) {
    return evaluate::unusable<evaluate::ViewCamera>(error.what());
  }
}

evaluate::Told<cv::Mat> depthOf(const sensor_msgs::Image& message, std::size_t max_pixels) {
  const DecodedDepth decoded = decodeDepth(message, max_pixels);
  return {decoded.metres, decoded.fault, true};
}

namespace {

geometry_msgs::Pose linkPose(const Eigen::Isometry3d& map_from_optical) {
  return toPose(map_from_optical * linkFromOptical().inverse());
}

}  // namespace

Localisation messageOf(const evaluate::LocalisationRow& row, const std::string& map_frame) {
  const evaluate::LocalisedQuery& result = row.result;
  Localisation message;
  message.header = headerOf(map_frame, timeOf(row.stamp_ns));
  message.pose = static_cast<std::uint32_t>(row.pose);
  message.map = row.map;
  message.query = row.query;
  message.detector = row.detector;
  message.status = wordOf(result.status);
  message.estimate.pose = linkPose(result.estimate.map_from_optical);
  for (int i = 0; i < 36; ++i)
    message.estimate.covariance[static_cast<std::size_t>(i)] = result.estimate.covariance(i / 6, i % 6);
  message.truth = linkPose(row.truth);
  message.error = result.error_m;
  message.rotation_error = result.error_deg * kRadPerDeg;
  message.inliers = static_cast<std::uint32_t>(result.estimate.inliers.size());
  message.key_frame_stream = row.key_frame.stream;
  message.key_frame = static_cast<std::int32_t>(row.key_frame.pose);
  message.retrieved = static_cast<std::uint32_t>(result.retrieved);
  return message;
}

LocalisationSummary messageOf(const std::vector<evaluate::LocalisationSummary>& rows) {
  LocalisationSummary message;
  for (const evaluate::LocalisationSummary& row : rows) {
    LocalisationSummaryRow out;
    out.map = row.map;
    out.query = row.query;
    out.detector = row.detector;
    out.queries = static_cast<std::uint32_t>(row.n);
    out.failures = static_cast<std::uint32_t>(row.failures);
    for (std::size_t i = 0; i < row.within.size(); ++i) {
      out.within[i] = row.within[i].mean;
      out.within_low[i] = row.within[i].ci_low;
      out.within_high[i] = row.within[i].ci_high;
    }
    out.median_error = row.median_error_m;
    out.median_rotation_error = row.median_error_deg * kRadPerDeg;
    message.rows.push_back(out);
  }
  return message;
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
    difference.difference = options.comparer.differences.at(d);
    difference.value = value.value;
    difference.features_a = value.features_a;
    difference.features_b = value.features_b;
    difference.matches = value.matches;
    difference.zero_second = value.zero_second;
    difference.symmetric = value.symmetric;
    difference.one_to_one = value.one_to_one;
    difference.matches_back = value.matches_back;
    difference.matches_one_to_one = value.matches_one_to_one;
    message.differences.push_back(difference);
  }
  return message;
}

sensor_msgs::ImagePtr messageOf(const cv::Mat& rgb, const std_msgs::Header& header) {
  return toImageMessage(rgb, sensor_msgs::image_encodings::RGB8, header);
}

Summary messageOf(const std::vector<evaluate::SummaryRow>& rows, std::size_t poses) {
  Summary message;
  message.poses = static_cast<std::uint32_t>(poses);
  for (const evaluate::SummaryRow& row : rows) {
    SummaryRow out;
    out.a = row.a;
    out.b = row.b;
    out.difference = row.difference;
    out.n = static_cast<std::uint32_t>(row.statistics.n);
    out.undefined = static_cast<std::uint32_t>(row.statistics.undefined);
    out.mean = row.statistics.mean;
    out.sd = row.statistics.sd;
    out.ci_low = row.statistics.ci_low;
    out.ci_high = row.statistics.ci_high;
    out.symmetric_mean = row.symmetric.mean;
    out.one_to_one_mean = row.one_to_one.mean;
    out.overmatched = static_cast<std::uint32_t>(row.overmatched);
    message.rows.push_back(out);
  }
  return message;
}

}  // namespace sunlit::ros_interface
