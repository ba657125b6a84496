/// Key points and descriptors.
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

namespace sunlit::evaluate {

/// What one detector found in one picture. Descriptors are one row each, CV_8U or CV_32F.
struct Features {
  std::vector<cv::KeyPoint> key_points;
  cv::Mat descriptors;
};

}  // namespace sunlit::evaluate
