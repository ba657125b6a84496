/// A first pose among sightings of which many may be wrong.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "sunlit/evaluate/localise/pose.h"

namespace sunlit::evaluate {

/// Points and pixels as OpenCV takes them.
struct PoseSearch {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> pixels;
  cv::Mat matrix;                 ///< of the camera
  cv::Mat rotation, translation;  ///< what is found, as cv::solvePnP gives it
};

/// By RANSAC on three points at a time; false where nothing was found.
bool searchPose(const PoseOptions& options, PoseSearch* search);

}  // namespace sunlit::evaluate
