#include "sunlit/evaluate/trajectory/pose_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

#include "sunlit/evaluate/statistics.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/range.h"

namespace sunlit::evaluate {
namespace {

/// Exact for small angles too, of which the cosine knows nothing.
double angleOf(const Eigen::Quaterniond& rotation) {
  return Angle::radians(2.0 * std::atan2(rotation.vec().norm(), std::abs(rotation.w()))).deg();
}

/// From pose `from` to pose `to`, in the frame of the former.
StampedPose motion(const StampedPose& from, const StampedPose& to) {
  StampedPose motion;
  const Eigen::Quaterniond back = from.orientation.conjugate();
  motion.position = back * (to.position - from.position);
  motion.orientation = back * to.orientation;
  return motion;
}

/// Of truth⁻¹ estimate.
void add(const StampedPose& truth, const StampedPose& estimate, PoseErrors* errors) {
  errors->translation_m.push_back((estimate.position - truth.position).norm());
  errors->rotation_deg.push_back(angleOf(truth.orientation.conjugate() * estimate.orientation));
}

constexpr const char* kAllowedDeltas = "metres above 0, such as 10m, or whole frames from 1, such as 1frame";

bool isAllowed(const Delta& delta) {
  if (delta.unit == Delta::Unit::kMetres) return Range::above(0.0).contains(delta.size);
  return Range::atLeast(1.0).contains(delta.size) && delta.size == std::floor(delta.size);
}

}  // namespace

PoseErrors absoluteErrors(const MatchedPoses& poses) {
  PoseErrors errors;
  for (std::size_t i = 0; i < poses.truth.size(); ++i) add(poses.truth[i], poses.estimate[i], &errors);
  return errors;
}

std::string Delta::name() const {
  return textOf(size) + (unit == Unit::kMetres ? "m" : "frame");
}

Delta parseDelta(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  Delta delta;
  std::string unit;
  const bool is_read = static_cast<bool>(stream >> delta.size >> unit) && stream.peek() == EOF;
  delta.unit = unit == "m" ? Delta::Unit::kMetres : Delta::Unit::kFrames;
  const bool is_unit = unit == "m" || unit == "frame" || unit == "frames";
  if (!is_read || !is_unit || !isAllowed(delta)) refuse("delta", '"' + text + '"', kAllowedDeltas);
  return delta;
}

std::vector<IndexPair> pairsApart(const Trajectory& trajectory, const Delta& delta) {
  if (!isAllowed(delta)) refuse("delta", delta.name(), kAllowedDeltas);
  std::vector<std::size_t> ends;
  double path = 0.0;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    if (delta.unit == Delta::Unit::kFrames) {
      if (std::fmod(static_cast<double>(i), delta.size) == 0.0) ends.push_back(i);
      continue;
    }
    if (i > 0) path += (trajectory[i].position - trajectory[i - 1].position).norm();
    if (path < delta.size) continue;
    ends.push_back(i);
    path = 0.0;
  }
  std::vector<IndexPair> pairs;
  for (std::size_t k = 1; k < ends.size(); ++k) pairs.push_back({ends[k - 1], ends[k]});
  return pairs;
}

PoseErrors relativeErrors(const MatchedPoses& poses, const Delta& delta, PathOf path) {
  PoseErrors errors;
  for (const IndexPair& pair : pairsApart(path == PathOf::kTruth ? poses.truth : poses.estimate, delta)) {
    add(motion(poses.truth[pair.first], poses.truth[pair.second]),
        motion(poses.estimate[pair.first], poses.estimate[pair.second]), &errors);
  }
  return errors;
}

ErrorStatistics statisticsOfErrors(const std::vector<double>& errors) {
  ErrorStatistics result{errors.size(), kNaN, kNaN, kNaN, kNaN, kNaN, kNaN, 0.0};
  if (errors.empty()) return result;
  const double n = static_cast<double>(errors.size());
  double sum = 0.0;
  for (const double error : errors) {
    sum += error;
    result.sse += error * error;
  }
  result.rmse = std::sqrt(result.sse / n);
  result.mean = sum / n;
  double deviations = 0.0;
  for (const double error : errors) deviations += (error - result.mean) * (error - result.mean);
  result.std = std::sqrt(deviations / n);
  std::vector<double> sorted = errors;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t middle = sorted.size() / 2;
  result.median = sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
  result.min = sorted.front();
  result.max = sorted.back();
  return result;
}

}  // namespace sunlit::evaluate
