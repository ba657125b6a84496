/// One picture, as every difference sees it.
#pragma once

#include <opencv2/core/mat.hpp>

#include "sunlit/image/images.h"

namespace sunlit::evaluate {

struct Picture {
  cv::Mat rgb;   ///< CV_8UC3, red first
  cv::Mat grey;  ///< CV_8UC1, cv::cvtColor of rgb (COLOR_RGB2GRAY), since detectors are defined on that
                 ///< conversion
};

/// Throws std::invalid_argument unless `rgb` is CV_8UC3 and not empty. Shares the pixels of `rgb`.
Picture makePicture(const cv::Mat& rgb);

/// As evaluations take pictures: CV_8UC3, red first. Shares the pixels of `picture`.
cv::Mat matOf(image::Rgb8Image& picture);

}  // namespace sunlit::evaluate
