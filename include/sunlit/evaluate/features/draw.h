/// A picture of what matched, to look at.
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>

#include "sunlit/evaluate/features/detector.h"
#include "sunlit/evaluate/features/matching.h"

namespace sunlit::evaluate {

/// Both images side by side with the accepted matches of the detector's features; without any where it is
/// null. Images and result are CV_8UC3, red first. Throws Stopped where `stop` says so.
cv::Mat drawMatches(const Detector* detector, const RatioTest& test, const std::array<cv::Mat, 2>& rgb,
                    const StopToken& stop = {});

}  // namespace sunlit::evaluate
