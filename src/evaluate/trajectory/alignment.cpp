#include "sunlit/evaluate/trajectory/alignment.h"

#include <Eigen/SVD>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sunlit::evaluate {
namespace {

/// Of singular values, and of the sums that give yaw. Squares of lengths: 1e-6 of a length.
constexpr double kDegenerate = 1e-12;

using Points = std::vector<Eigen::Vector3d>;

/// Positions less their mean.
struct Centred {
  /// By way of differences from the first, so that positions that are all the same become 0 to the bit.
  explicit Centred(const Trajectory& trajectory) : mean(trajectory.front().position) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const StampedPose& pose : trajectory) sum += pose.position - mean;
    mean += sum / static_cast<double>(trajectory.size());
    for (const StampedPose& pose : trajectory) points.emplace_back(pose.position - mean);
  }
  Eigen::Vector3d mean;
  Points points;
};

/// Σ bᵢ aᵢᵀ.
Eigen::Matrix3d products(const Points& b, const Points& a) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) sum += b[i] * a[i].transpose();
  return sum;
}

double squares(const Points& points) {
  double sum = 0.0;
  for (const Eigen::Vector3d& point : points) sum += point.squaredNorm();
  return sum;
}

/// What a turn about an axis hangs on: Similarity::loose_rad's u, and Σ r · r′ / n.
struct Turn {
  Eigen::Vector3d axis;
  double decided_m2;
};

double loose(const Similarity& fitted, const Centred& estimate, const Centred& truth, const Turn& turn) {
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.points.size(); ++i) {
    const Eigen::Vector3d error = truth.points[i] - fitted.scale * (fitted.rotation * estimate.points[i]);
    const double torque = turn.axis.dot(truth.points[i].cross(error));
    sum += torque * torque;
  }
  return sum > 0.0 ? std::sqrt(sum / static_cast<double>(truth.points.size())) / turn.decided_m2 : 0.0;
}

/// In the names of Umeyama: x the estimate, y the truth.
Similarity umeyama(const Centred& x, const Centred& y, bool with_scale) {
  const double n = static_cast<double>(x.points.size());
  const Eigen::Matrix3d covariance = products(y.points, x.points) / n;  // eq. 38
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d& d = svd.singularValues();
  if (!(d[1] > kDegenerate * d[0])) {
    throw std::invalid_argument(
        "the positions of the truth or of the estimate are all on one line or at one point, which leaves "
        "open how to turn the estimate; align by yaw, or not at all");
  }
  Eigen::Vector3d s(1.0, 1.0, 1.0);  // eq. 43
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) {
    s[2] = -1.0;
    if (!(d[1] - d[2] > kDegenerate * d[0])) {
      throw std::invalid_argument(
          "the estimate is the truth mirrored, and as long along one axis as along another, which "
          "leaves open how to turn it; align by yaw, or not at all");
    }
  }
  Similarity result;
  result.rotation = svd.matrixU() * s.asDiagonal() * svd.matrixV().transpose();  // eq. 40
  if (with_scale) result.scale = d.dot(s) / (squares(x.points) / n);             // eq. 42, 36
  result.translation = y.mean - result.scale * (result.rotation * x.mean);       // eq. 41
  // About the first axis; about the others these sums are larger.
  result.loose_rad = loose(result, x, y, {svd.matrixU().col(0), d[1] + s[2] * d[2]});
  return result;
}

Similarity yaw(const Centred& a, const Centred& b) {
  const Eigen::Matrix3d sums = products(b.points, a.points);
  const double along = sums(0, 0) + sums(1, 1);
  const double across = sums(1, 0) - sums(0, 1);
  const double all = std::sqrt(squares(a.points) * squares(b.points));
  if (!(std::hypot(along, across) > kDegenerate * all)) {
    throw std::invalid_argument(
        "the positions of the truth or of the estimate are all at one place seen from above, or one is the "
        "other mirrored there, which leaves open how to turn the estimate; do not align");
  }
  Similarity result;
  result.rotation = Eigen::AngleAxisd(std::atan2(across, along), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  result.translation = b.mean - result.rotation * a.mean;
  result.loose_rad =
      loose(result, a, b,
            {Eigen::Vector3d::UnitZ(), std::hypot(along, across) / static_cast<double>(a.points.size())});
  return result;
}

}  // namespace

std::size_t leastPoses(Alignment alignment) {
  if (alignment == Alignment::kNone) return 1;
  return alignment == Alignment::kYaw ? 2 : 3;
}

Similarity truthFromEstimate(Alignment alignment, const MatchedPoses& poses) {
  const std::size_t least = leastPoses(alignment);
  if (poses.truth.size() < least) {
    throw std::invalid_argument("the alignment needs " + std::to_string(least) + " pairs of poses, but has " +
                                std::to_string(poses.truth.size()));
  }
  if (alignment == Alignment::kNone) return {};
  const Centred truth(poses.truth), estimate(poses.estimate);
  if (alignment == Alignment::kYaw) return yaw(estimate, truth);
  return umeyama(estimate, truth, alignment == Alignment::kSim3);
}

Trajectory aligned(const Similarity& truth_from_estimate, Trajectory estimate) {
  const Eigen::Quaterniond rotation(truth_from_estimate.rotation);
  for (StampedPose& pose : estimate) {
    pose.position = truth_from_estimate * pose.position;
    pose.orientation = rotation * pose.orientation;
  }
  return estimate;
}

}  // namespace sunlit::evaluate
