/// A picture of what matched, to look at.
#pragma once

#include <opencv2/core/mat.hpp>

#include "sunlit/evaluate/differences/comparer.h"

namespace sunlit::evaluate {

/// Both images side by side with the accepted matches of the first of the differences that uses features;
/// without lines where none does. Images and result are CV_8UC3, red first.
cv::Mat drawMatches(const ComparerOptions& options, const cv::Mat& rgb_a, const cv::Mat& rgb_b);

}  // namespace sunlit::evaluate
