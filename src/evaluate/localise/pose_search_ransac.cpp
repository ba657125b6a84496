// By the RANSAC that OpenCV had before USAC. It draws a fourth point to tell three points' poses apart,
// counts inliers, and always draws alike: the seed is that of the order in which it is given the points.
#include <algorithm>
#include <numeric>
#include <opencv2/calib3d.hpp>
#include <random>

#include "evaluate/localise/pose_search.h"

namespace sunlit::evaluate {

bool searchPose(const PoseOptions& options, PoseSearch* search) {
  constexpr std::size_t kDrawn = 4;
  const std::size_t count = search->points.size();
  if (count < kDrawn) return false;
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937 random(static_cast<std::mt19937::result_type>(options.seed));
  for (std::size_t i = count - 1; i > 0; --i) std::swap(order[i], order[random() % (i + 1)]);
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> pixels;
  for (const std::size_t i : order) {
    points.push_back(search->points[i]);
    pixels.push_back(search->pixels[i]);
  }
  return cv::solvePnPRansac(points, pixels, search->matrix, cv::noArray(), search->rotation,
                            search->translation, false, options.iterations,
                            static_cast<float>(options.reprojection_px), options.confidence, cv::noArray(),
                            cv::SOLVEPNP_P3P);
}

}  // namespace sunlit::evaluate
