#include "sunlit/evaluate/localise/pose.h"

#include <Eigen/LU>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <stdexcept>
#include <utility>

#include "evaluate/localise/pose_search.h"

namespace sunlit::evaluate {
namespace {

constexpr int kMostRefinements = 3;

/// Points and pixels for OpenCV. It keeps single precision on its way, so points are taken from
/// their own midst: coordinates of a large grid would lose their centimetres.
class Problem {
 public:
  Problem(const std::vector<Sighting>& sightings, const image::PinholeCamera& camera) {
    for (const Sighting& sighting : sightings) middle_ += sighting.point;
    middle_ /= static_cast<double>(sightings.size());
    for (const Sighting& sighting : sightings) {
      const Eigen::Vector3d point = sighting.point - middle_;
      search_.points.emplace_back(point.x(), point.y(), point.z());
      search_.pixels.emplace_back(sighting.pixel.x(), sighting.pixel.y());
    }
    search_.matrix = (cv::Mat_<double>(3, 3) << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  }

  bool search(const PoseOptions& options) {
    return searchPose(options, &search_) && cv::checkRange(search_.rotation) &&
           cv::checkRange(search_.translation);
  }

  void refine(const std::vector<std::size_t>& inliers) {
    std::vector<cv::Point3d> points;
    std::vector<cv::Point2d> pixels;
    for (const std::size_t i : inliers) {
      points.push_back(search_.points[i]);
      pixels.push_back(search_.pixels[i]);
    }
    cv::solvePnPRefineLM(points, pixels, search_.matrix, cv::noArray(), search_.rotation,
                         search_.translation);
  }

  Eigen::Isometry3d mapFromOptical() const {
    cv::Mat matrix;
    cv::Rodrigues(search_.rotation, matrix);
    Eigen::Matrix3d rotation;
    Eigen::Vector3d translation;
    cv::cv2eigen(matrix, rotation);
    cv::cv2eigen(search_.translation, translation);
    return Eigen::Translation3d(middle_ - rotation.transpose() * translation) *
           Eigen::Quaterniond(rotation.transpose()).normalized();
  }

 private:
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
  PoseSearch search_;
};

std::vector<std::size_t> inliersOf(const std::vector<Sighting>& sightings, const image::PinholeCamera& camera,
                                   const Eigen::Isometry3d& map_from_optical, double within_px) {
  const Eigen::Isometry3d optical_from_map = map_from_optical.inverse();
  std::vector<std::size_t> inliers;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const Eigen::Vector3d point = optical_from_map * sightings[i].point;
    if (!(point.z() > 0.0)) continue;
    if ((camera.project(point) - sightings[i].pixel).norm() <= within_px) inliers.push_back(i);
  }
  return inliers;
}

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

/// With the camera moved by δ and turned by ω about axes of `map`, a point p stands at Rᵀ (p − c − δ) turned
/// back by ω: its derivatives are −Rᵀ and Rᵀ [p − c]×.
PoseCovariance covarianceOf(const std::vector<Sighting>& sightings, const image::PinholeCamera& camera,
                            const PoseEstimate& estimate) {
  const Eigen::Isometry3d& pose = estimate.map_from_optical;
  const Eigen::Matrix3d optical_from_map = pose.linear().transpose();
  PoseCovariance information = PoseCovariance::Zero();
  double squares = 0.0;
  for (const std::size_t i : estimate.inliers) {
    const Eigen::Vector3d from_camera = sightings[i].point - pose.translation();
    const Eigen::Vector3d seen = optical_from_map * from_camera;
    Eigen::Matrix<double, 2, 3> pixel_by_point;
    pixel_by_point << camera.fx / seen.z(), 0, -camera.fx * seen.x() / (seen.z() * seen.z()), 0,
        camera.fy / seen.z(), -camera.fy * seen.y() / (seen.z() * seen.z());
    Eigen::Matrix<double, 3, 6> point_by_pose;
    point_by_pose << -optical_from_map, optical_from_map * crossMatrix(from_camera);
    const Eigen::Matrix<double, 2, 6> jacobian = pixel_by_point * point_by_pose;
    information += jacobian.transpose() * jacobian;
    squares += (camera.project(seen) - sightings[i].pixel).squaredNorm();
  }
  const double freedom = 2.0 * static_cast<double>(estimate.inliers.size()) - 6.0;
  return squares / freedom * information.inverse();
}

}  // namespace

std::optional<PoseEstimate> estimatePose(const std::vector<Sighting>& sightings,
                                         const image::PinholeCamera& camera, const PoseOptions& options) {
  requireFields(options);
  for (const Sighting& sighting : sightings) {
    if (!sighting.point.allFinite() || !sighting.pixel.allFinite())
      throw std::invalid_argument("a sighting is not finite");
  }
  const auto least = static_cast<std::size_t>(options.min_inliers);
  if (sightings.size() < least) return std::nullopt;
  Problem problem(sightings, camera);
  if (!problem.search(options)) return std::nullopt;
  PoseEstimate estimate;
  for (int round = 0;; ++round) {
    const Eigen::Isometry3d pose = problem.mapFromOptical();
    std::vector<std::size_t> inliers = inliersOf(sightings, camera, pose, options.reprojection_px);
    if (inliers.size() < least) break;  // least squares may push some out: the pose before has enough
    const bool is_settled = inliers == estimate.inliers;
    estimate.map_from_optical = pose;
    estimate.inliers = std::move(inliers);
    if (is_settled || round == kMostRefinements) break;
    problem.refine(estimate.inliers);
  }
  if (estimate.inliers.empty() || !estimate.map_from_optical.matrix().allFinite()) return std::nullopt;
  estimate.covariance = covarianceOf(sightings, camera, estimate);
  return estimate;
}

double angleBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::Quaterniond(a.linear()).angularDistance(Eigen::Quaterniond(b.linear()));
}

}  // namespace sunlit::evaluate
