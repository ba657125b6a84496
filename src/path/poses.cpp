#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "path/waypoint_check.h"
#include "sunlit/path/path.h"
#include "sunlit/quantity/frames.h"

namespace sunlit::path {
namespace {

/// Waypoints nearer than this to each other in plan view, m, give no heading worth the name.
constexpr double kNearest_m = 1e-3;

/// A pose that would lie within this part of the spacing before a segment's end, or beyond, is the next
/// segment's start: a length of exactly n spacings must not get an (n+1)th pose by the rounding of its square
/// root.
constexpr double kEndTolerance = 1e-6;

/// More poses than this are a mistake of spacing, and would fill the memory.
constexpr double kMostPoses = 1e7;

/// On a segment, which has one at its start even where these are none.
double posesWanted(double length_m, const PathOptions& options) {
  return std::ceil(length_m / options.spacing_m - kEndTolerance);
}

[[noreturn]] void failAt(std::size_t index, const std::string& wrong) {
  throw std::invalid_argument("waypoint " + std::to_string(index) + ": " + wrong);
}

}  // namespace

bool areTooNear(const Eigen::Vector3d& point, const Eigen::Vector3d& previous) {
  return (point - previous).head<2>().norm() < kNearest_m;
}

std::optional<std::string> faultOf(const Eigen::Vector3d& point, const Eigen::Vector3d* previous) {
  for (int axis = 0; axis < 3; ++axis) {
    if (kPoseRange_m.contains(point[axis])) continue;
    return refusal(std::string(1, "xyz"[axis]), textOf(point[axis]), kPoseRange_m.words() + " m");
  }
  if (previous != nullptr && areTooNear(point, *previous)) {
    return "it is less than 1 mm from the waypoint before it in plan view; leave it out";
  }
  return std::nullopt;
}

std::string tooFew(std::size_t count) {
  return "a path needs two waypoints or more, there " +
         (count == 1 ? std::string("is 1") : "are " + std::to_string(count));
}

void validate(const PathOptions& options) {
  requireFields(options);
}

std::string driveOf(const PathOptions& options) {
  if (options.offset_m == 0.0 && options.yaw == Angle()) return "";
  char text[80];
  // + 0: a zero has no sign.
  std::snprintf(text, sizeof text, "offset %.9g m, yaw %.9g deg", options.offset_m + 0.0,
                options.yaw.deg() + 0.0);
  return text;
}

void requireWithin(const PoseSelection& selection, int poses, const std::string& prefix) {
  if (selection.first < poses && selection.end(poses) <= poses) return;
  throw std::invalid_argument(prefix + "first " + std::to_string(selection.first) + " and " + prefix +
                              "count " + std::to_string(selection.count) + " ask for more than the path's " +
                              std::to_string(poses) + " poses");
}

std::int64_t nanosecondsTo(int index, double rate_hz) {
  constexpr std::int64_t kNanosecondsPerSecond = 1000000000;
  // Split, so that a long run at a high rate keeps its nanoseconds.
  const double seconds = static_cast<double>(index) / rate_hz;
  const double whole_seconds = std::floor(seconds);
  return static_cast<std::int64_t>(whole_seconds) * kNanosecondsPerSecond +
         static_cast<std::int64_t>(std::llround((seconds - whole_seconds) * 1e9));
}

Waypoints withoutStandstills(const Waypoints& waypoints) {
  Waypoints kept;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    if (const auto fault = faultOf(waypoints[i], nullptr)) failAt(i, *fault);
    if (kept.empty() || !areTooNear(waypoints[i], kept.back())) kept.push_back(waypoints[i]);
  }
  return kept;
}

std::string leftOutText(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " pose" : " poses") +
         " left out, less than 1 mm in plan view from the one before";
}

std::string crowdedText(const Waypoints& waypoints, const PathOptions& options) {
  constexpr double kNearBy = 0.1, kMany = 0.2;  // of the spacing, of the poses
  std::size_t poses = 0, crowded = 0;
  double nearest_m = std::numeric_limits<double>::infinity(), farthest_m = 0.0, longest_m = 0.0;
  for (std::size_t i = 0; i + 1 < waypoints.size(); ++i) {
    const double length_m = (waypoints[i + 1] - waypoints[i]).norm();
    const double count = posesWanted(length_m, options);
    poses += static_cast<std::size_t>(std::max(count, 1.0));
    longest_m = std::max(longest_m, length_m);
    const bool is_last = i + 2 == waypoints.size();  // no pose follows there
    if (is_last || count < 2.0 || length_m - (count - 1.0) * options.spacing_m >= kNearBy * options.spacing_m)
      continue;
    ++crowded;
    nearest_m = std::min(nearest_m, length_m);
    farthest_m = std::max(farthest_m, length_m);
  }
  if (crowded == 0 || static_cast<double>(crowded) < kMany * static_cast<double>(poses)) return "";
  const std::string nearest = textOf(nearest_m, 3), farthest = textOf(farthest_m, 3);
  std::string text =
      std::to_string(crowded) + " of " + std::to_string(poses) +
      " poses lie less than a tenth of the spacing behind the one before, since waypoints are " +
      (nearest == farthest ? "" : nearest + " to ") + farthest + " m apart";
  // With two digits, and not below it.
  const double digit = std::pow(10.0, std::floor(std::log10(longest_m)) - 1.0);
  if (longest_m < (1.0 + kNearBy) * options.spacing_m)
    text += ": a spacing of " + textOf(digit * std::ceil(longest_m / digit), 3) + " m takes one a waypoint";
  return text;
}

std::vector<Eigen::Isometry3d> posesAlong(const Waypoints& waypoints, const PathOptions& options) {
  validate(options);
  if (waypoints.size() < 2) throw std::invalid_argument(tooFew(waypoints.size()));
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    if (const auto fault = faultOf(waypoints[i], i == 0 ? nullptr : &waypoints[i - 1])) failAt(i, *fault);
  }

  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t i = 0; i + 1 < waypoints.size(); ++i) {
    const Eigen::Vector3d along = waypoints[i + 1] - waypoints[i];
    const double length = along.norm();
    const double heading = std::atan2(along.y(), along.x());
    const Eigen::Vector3d left(-std::sin(heading), std::cos(heading), 0.0);
    const Eigen::Vector3d moved = Eigen::Vector3d(0.0, 0.0, options.height_m) + options.offset_m * left;
    const double yaw = heading + options.yaw.rad();
    const double wanted = posesWanted(length, options);
    if (static_cast<double>(poses.size()) + wanted > kMostPoses) {
      failAt(i, "from here to the next are " + std::to_string(length) +
                    " m, more poses than the 10 million allowed");
    }
    const auto count = static_cast<std::size_t>(wanted);
    for (std::size_t k = 0; k == 0 || k < count; ++k) {
      const double distance = static_cast<double>(k) * options.spacing_m;
      Eigen::Isometry3d map_from_camera_link = Eigen::Isometry3d::Identity();
      map_from_camera_link.translation() = waypoints[i] + along * (distance / length) + moved;
      map_from_camera_link.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      poses.push_back(map_from_camera_link);
    }
  }
  return poses;
}

Motion motionAt(const std::vector<Eigen::Isometry3d>& poses, int index, const Pace& pace) {
  const std::size_t at = static_cast<std::size_t>(index), last = poses.size() - 1;
  const double speed_m_s = pace.speed_m_s.value_or(pace.spacing_m * pace.rate_hz);
  if (poses.size() < 2 || speed_m_s <= 0.0) return {};
  // Poses of one segment look one way. Its last one may have the way to the next segment beside it, not
  // before it.
  const bool ends = at == last || poses[at].linear() != poses[at + 1].linear();
  const bool came_along = at > 0 && poses[at - 1].linear() == poses[at].linear();
  if (at == last && !came_along) {
    // Alone on its segment, of which only its heading tells: it goes as the one before, turned by as much.
    const Eigen::Matrix3d turned = poses[at].linear() * poses[at - 1].linear().transpose();
    return {turned * motionAt(poses, index - 1, pace).velocity_m_s, Eigen::Vector3d::Zero()};
  }
  const std::size_t from = ends && came_along ? at - 1 : at;
  Motion motion;
  motion.velocity_m_s = speed_m_s * (poses[from + 1].translation() - poses[from].translation()).normalized();
  if (at < last)
    motion.turning_rad_s =
        Motion::between(poses[at], poses[at + 1], pace.spacing_m / speed_m_s).turning_rad_s;
  return motion;
}

}  // namespace sunlit::path
