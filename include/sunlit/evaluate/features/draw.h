/// A picture of what matched, to look at.
#pragma once

#include <opencv2/core/mat.hpp>

#include "sunlit/evaluate/features/detector.h"
#include "sunlit/evaluate/features/matching.h"

namespace sunlit::evaluate {

/// Both images side by side with the accepted matches of the detector's features; without any where it is
/// null. Images and result are CV_8UC3, red first.
cv::Mat drawMatches(const Detector* detector, const RatioTest& test, const cv::Mat& rgb_a,
                    const cv::Mat& rgb_b);

}  // namespace sunlit::evaluate
