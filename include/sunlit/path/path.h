/// Waypoints to camera poses.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/field.h"
#include "sunlit/quantity/motion.h"

namespace sunlit::path {

/// Points in `map`, m, in driving order, on the ground that the camera drives over.
using Waypoints = std::vector<Eigen::Vector3d>;

struct PathOptions {
  double spacing_m = 1.0;
  double height_m = 1.0;
  double offset_m = 0.0;  ///< to the left of the path: another drive along it, pose by pose
  Angle yaw = Angle();    ///< of the camera, to the left of where it goes
};

inline std::vector<Field> fieldsOf(PathOptions& options) {
  return {{"spacing", &options.spacing_m, "m", {0.001, 1000}, "between poses, from each waypoint on"},
          {"camera_height", &options.height_m, "m", {-1000, 1000}, "of the camera above the waypoints"},
          {"offset", &options.offset_m, "m", {-1000, 1000}, "of the camera to the left of the path"},
          {"yaw", &options.yaw, "deg", {-180, 180}, "of the camera, to the left of where it goes"}};
}

/// Throws std::invalid_argument naming key, value and range.
void validate(const PathOptions& options);

/// What tells the pictures of a drive beside the path, or of a camera that is turned, from those of its poses
/// on the path: image::PictureName::drive. Empty where there is neither an offset nor a yaw.
std::string driveOf(const PathOptions& options);

/// Which poses of a path are taken. Each keeps its index, and so its stamp, among all poses of the path.
struct PoseSelection {
  int first = 0;
  int count = 0;
  int stride = 1;

  /// The index behind the last of `poses`; taken are first, first + stride, … below it.
  int end(int poses) const { return count == 0 ? poses : first + count; }
};

inline std::vector<Field> fieldsOf(PoseSelection& selection) {
  constexpr double kLargest = 1e9;
  return {{"first", &selection.first, "", {0, kLargest}, "index of the first pose to render"},
          {"count", &selection.count, "", {0, kLargest}, "how many indices from there; 0: to the end"},
          {"stride",
           &selection.stride,
           "",
           {1, kLargest},
           "only every n-th; index and stamp stay those of the path"}};
}

/// Throws std::invalid_argument where `selection` asks for more than so many poses; what is to be called
/// `prefix` + "first" and so on.
void requireWithin(const PoseSelection& selection, int poses, const std::string& prefix);

/// From pose 0 to pose `index` ≥ 0 of those taken at so many a second, ns.
std::int64_t nanosecondsTo(int index, double rate_hz);

/// map_from_camera_link of every pose, by the paper's rule: poses every `spacing_m` from the start of each
/// segment between two waypoints, while short of its end; then the start of the next segment. The camera is
/// level (parallel to the ground plane) and points at the next waypoint in plan view; with `offset_m` and
/// `yaw` each pose is then moved sideways and turned, so that there are as many, each beside its own. Throws
/// std::invalid_argument naming the waypoint for fewer than two points, a coordinate that is not within
/// ±10,000 km, two consecutive points less than 1 mm apart in plan view, or more than 10 million poses.
std::vector<Eigen::Isometry3d> posesAlong(const Waypoints& waypoints, const PathOptions& options);

/// What is told of posesAlong() where a fifth of its poses or more lie less than a tenth of the spacing
/// behind the one before, since waypoints are a little farther apart than so many spacings; empty where they
/// do not.
std::string crowdedText(const Waypoints& waypoints, const PathOptions& options);

/// What was recorded or planned may stand still: `waypoints` without those less than 1 mm in plan view from
/// the last one that is kept. Throws std::invalid_argument naming the waypoint, by its place in `waypoints`,
/// for a coordinate that is not within ±10,000 km.
Waypoints withoutStandstills(const Waypoints& waypoints);

/// What is told where `count` poses were left out so.
std::string leftOutText(std::size_t count);

/// How fast poses follow each other.
struct Pace {
  double rate_hz = 10.0;
  std::optional<double> speed_m_s = {};  ///< nothing: a spacing in the time between two pictures
  double spacing_m = 1.0;                ///< PathOptions::spacing_m of the poses
};

/// What people may ask for beside a rate, kept at `place`.
inline Field speedRow(std::optional<double>* place) {
  return {"speed",
          NumberOrWord{place, "auto"},
          "m/s",
          {0, 1000},
          "of the camera while a picture is taken; auto: as stamps say"};
}

/// How a camera moves at pose `index` of posesAlong(): straight along the segment of the pose, always at one
/// speed, though a segment's last pose may be nearer to the next than a spacing. Where the next pose is
/// turned, it turns by as much within a spacing. The last pose, where its segment has no other, climbs as the
/// segment before it. None of a single pose.
Motion motionAt(const std::vector<Eigen::Isometry3d>& poses, int index, const Pace& pace);

/// Waypoints from a file: CSV (x,y,z or x,y a line, m; an optional header line; # comments) or TUM trajectory
/// (timestamp tx ty tz qx qy qz qw, blank-separated; the orientation is not used, and z is taken for the
/// ground's, so that of a camera's own trajectory PathOptions::height_m is 0). Which of the two is told by
/// commas. Throws std::runtime_error with path, line and what is wrong there; all that posesAlong checks is
/// checked here too, but poses of a trajectory less than 1 mm from the last before are left out, since what
/// was recorded stands still at its ends: `told` hears how many, in a line, where there are some.
Waypoints readWaypoints(const std::string& file, const std::function<void(const std::string&)>& told = {});

}  // namespace sunlit::path
