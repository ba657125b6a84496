/// Where a camera is, from points that it sees and whose places are known.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

#include "sunlit/image/camera.h"
#include "sunlit/quantity/field.h"

namespace sunlit::evaluate {

struct PoseOptions {
  double reprojection_px = 4.0;  ///< 0.6 % of a width of 640 px, as hloc takes 12 px of some 1,600
  int iterations = 10000;
  double confidence = 0.9999;
  int min_inliers = 12;
  int seed = 1;  // any: what counts is that it is always the same
};

inline std::vector<Field> fieldsOf(PoseOptions& options) {
  return {{"reprojection", &options.reprojection_px, "px", Range::above(0, 1000),
           "by which a point of the map may miss where it is seen to support a pose"},
          {"iterations", &options.iterations, "", {1, 1e6}, "of RANSAC at most"},
          {"confidence",
           &options.confidence,
           "",
           {0.01, 0.999999},
           "of having found the best pose, at which RANSAC ends"},
          {"min_inliers", &options.min_inliers, "", {4, 1e6}, "points that must support a pose"},
          {"seed", &options.seed, "", {0, 2147483647}, "of RANSAC"}};
}

/// A point of the map and where the camera sees it.
struct Sighting {
  Eigen::Vector3d point;  ///< in `map`, m
  Eigen::Vector2d pixel;
};

/// Of (x, y, z, about x, about y, about z), m and rad: fixed axes of `map`, about the camera's place, as in
/// geometry_msgs/PoseWithCovariance.
using PoseCovariance = Eigen::Matrix<double, 6, 6>;

struct PoseEstimate {
  Eigen::Isometry3d map_from_optical = Eigen::Isometry3d::Identity();
  /// σ² (JᵀJ)⁻¹ with J the derivative of the inliers' pixels by the pose and σ² their squared errors per
  /// degree of freedom, 2 n − 6 (Hartley & Zisserman, *Multiple View Geometry*, 2nd ed. 2004, result 5.10).
  /// It knows noise of the pixels, not of the map.
  PoseCovariance covariance = PoseCovariance::Zero();
  std::vector<std::size_t> inliers;  ///< indices of sightings within reprojection_px, ascending
};

/// Perspective-n-point by RANSAC (OpenCV's USAC, before 4.5 its older one; one thread, seeded, three points
/// at a time), refined by Levenberg and Marquardt on what supports it until that changes no more, three times
/// at most. None where fewer than min_inliers sightings support a pose. Result depends on the arguments
/// alone. Throws std::invalid_argument for options out of range and sightings that are not finite.
std::optional<PoseEstimate> estimatePose(const std::vector<Sighting>& sightings,
                                         const image::PinholeCamera& camera, const PoseOptions& options);

/// The angle, rad, of the rotation that takes one orientation to the other: 0 … π.
double angleBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b);

}  // namespace sunlit::evaluate
