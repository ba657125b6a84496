/// The transform that lays an estimate onto the truth.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "sunlit/evaluate/trajectory/trajectory.h"

namespace sunlit::evaluate {

/// What of an estimate may be undone before it is compared.
enum class Alignment {
  kNone,  ///< nothing: both are in one frame
  kSe3,   ///< rotation and translation
  kSim3,  ///< scale too: of a single camera
  kYaw,   ///< rotation about z and translation: of what knows where down is, such as a camera with an IMU
};

/// p ↦ scale · rotation · p + translation.
struct Similarity {
  double scale = 1.0;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  /// How loose the rotation is: as if the errors that it leaves were all of one sign, they would turn it so
  /// far about the axis about which positions decide it least, which is the line of a drive along a line.
  /// √(Σ (u · (r × e))² / n) / (Σ r · r′ / n), u being that axis, r and r′ where truth and estimate lie off
  /// it, e their distance. 0 where nothing was fitted; may exceed π.
  double loose_rad = 0.0;

  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return scale * (rotation * point) + translation;
  }
};

/// Poses of one moment each at the same index, and as many of both.
struct MatchedPoses {
  Trajectory truth, estimate;
};

/// How many pairs of poses `alignment` needs at least: 3, for kYaw 2, for kNone 1.
std::size_t leastPoses(Alignment alignment);

/// truth_from_estimate with the least sum of squared distances between positions.
///
/// kSe3, kSim3: S. Umeyama, Least-squares estimation of transformation parameters between two point patterns,
/// PAMI 13 (4), 1991, eq. 34-43; a rotation even where a reflection would be nearer. kYaw: with â and b̂ the
/// positions of estimate and truth less their means, θ = atan2(Σ âx b̂y − ây b̂x, Σ âx b̂x + ây b̂y), and the
/// translation takes mean to mean; all squares that depend on θ are −2 (C cos θ + S sin θ) with these two
/// sums S and C.
///
/// Throws std::invalid_argument, saying what is wrong and what would do, for fewer than leastPoses(), and
/// where the rotation is anybody's choice. For kSe3 and kSim3 that is: positions of either that are all the
/// same or all on a line; told by the second singular value of the covariance being at most 1e-12 of the
/// first, as for a drive that leaves its line by a millionth of its length; or a reflection that is nearer,
/// with a second and third singular value that differ by no more. For kYaw: positions of either that are all
/// above each other, or of which one is, from above, such a mirror image of the other that all angles are as
/// good; told by √(S² + C²) being at most 1e-12 of √(Σ ‖â‖² Σ ‖b̂‖²).
Similarity truthFromEstimate(Alignment alignment, const MatchedPoses& poses);

/// `estimate` in the frame of the truth. Orientations are turned, not scaled.
Trajectory aligned(const Similarity& truth_from_estimate, Trajectory estimate);

}  // namespace sunlit::evaluate
