/// Trajectories, and the files that hold them.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

namespace sunlit::evaluate {

/// Where a body was at a moment: what takes points from its frame to that of the trajectory.
struct StampedPose {
  std::int64_t stamp_ns = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< m
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< of unit length
};

/// Stamps increase from pose to pose.
using Trajectory = std::vector<StampedPose>;

/// How far from 1 the length of a quaternion in a file may be, which is then made 1: three digits after the
/// point leave up to this much.
inline constexpr double kQuaternionTolerance = 1e-3;

/// The poses of a file. Two forms, of lines that may have blanks, tabs or commas between their columns; #
/// starts a comment:
///  - TUM: timestamp tx ty tz qx qy qz qw, in s and m; in ns where the first stamp is beyond ±9.2e9, more
///  than
///    seconds can be, as ORB-SLAM3's SaveTrajectoryEuRoC() has it;
///  - EuRoC ground truth: timestamp, x, y, z, qw, qx, qy, qz and further columns, which are not used, in ns
///    and m; told by a comment ahead of the first pose that names q_RS_w, as their own files have it, or by
///    17 columns with commas.
/// Stamps keep every nanosecond, in whatever form ("1403715529.112143517", "1.403715529112143517e+09");
/// finer digits are rounded. Throws std::runtime_error "file:line: what, and what is expected" for a line of
/// another form, a number that is not finite, a coordinate beyond ±1e9 m, a stamp that is not above the one
/// before or beyond ±9.2e9 s in the unit of the file, nanoseconds that would be more than 5000 poses a
/// second, a quaternion that is not of unit length; and for a file that cannot be read or holds no pose.
///
/// Some published files, such as the truth of TUM's freiburg2_desk, have a stamp twice. With `repeated` poses
/// after the first of a stamp are left out, and their stamps added to it, instead of an error.
Trajectory readTrajectory(const std::string& file, std::vector<std::int64_t>* repeated = nullptr);

/// As TUM: a comment that names the columns, and a line a pose with stamps to the nanosecond and 17 digits.
/// Leaves the whole file or what was there. Throws std::runtime_error with path and reason.
void writeTrajectory(const std::string& file, const Trajectory& trajectory);

/// At `stamp_ns` between two moments, of which `after` is later: along a straight line, and turning at one
/// rate the shorter way round.
StampedPose interpolated(const StampedPose& before, const StampedPose& after, std::int64_t stamp_ns);

/// From pose to pose along straight lines, m.
double lengthOf(const Trajectory& trajectory);

}  // namespace sunlit::evaluate
