#include "sunlit/evaluate/view_camera.h"

#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit::evaluate {
namespace {

/// Where the pinhole has what the lens shows at `pixel`.
std::optional<Eigen::Vector2d> straight(const ViewCamera& camera, const cv::Point2f& pixel) {
  const std::optional<Eigen::Vector3d> ray = camera.unproject({pixel.x, pixel.y});
  if (!ray || std::atan2(ray->head<2>().norm(), ray->z()) > kStraightWithin_deg * kRadPerDeg)
    return std::nullopt;
  return camera.image::PinholeCamera::project(*ray);
}

}  // namespace

StraightFeatures straightOnes(const Features& features, const ViewCamera& camera) {
  if (!camera.lens) return {features, features};
  StraightFeatures ones;
  for (std::size_t i = 0; i < features.key_points.size(); ++i) {
    cv::KeyPoint key_point = features.key_points[i];
    const std::optional<Eigen::Vector2d> at = straight(camera, key_point.pt);
    if (!at) continue;
    ones.seen.key_points.push_back(key_point);
    ones.seen.descriptors.push_back(features.descriptors.row(static_cast<int>(i)));
    key_point.pt = {static_cast<float>(at->x()), static_cast<float>(at->y())};
    ones.straight.key_points.push_back(key_point);
  }
  ones.straight.descriptors = ones.seen.descriptors;
  return ones;
}

}  // namespace sunlit::evaluate
