/// RootSIFT: SIFT compared by the Hellinger distance of its histograms.
#pragma once

#include <opencv2/core/mat.hpp>

namespace sunlit::evaluate {

/// Of descriptors of SIFT (one row each, numbers ≥ 0) the square roots of the shares that their numbers have
/// of their sum, so that Euclidean distances are Hellinger distances (R. Arandjelović, A. Zisserman, CVPR
/// 2012). CV_32F rows of length 1; where the sum is 0 all are 0.
cv::Mat rootSift(const cv::Mat& descriptors);

}  // namespace sunlit::evaluate
