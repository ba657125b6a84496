/// Differences of pixels, equations (3) to (6) of the paper.
#pragma once

#include <opencv2/core/mat.hpp>

namespace sunlit::evaluate {

/// One picture, as every difference sees it.
struct Picture {
  cv::Mat rgb;   ///< CV_8UC3, red first
  cv::Mat grey;  ///< CV_8UC1, cv::cvtColor of rgb (COLOR_RGB2GRAY), since detectors are defined on that
                 ///< conversion
};

/// Throws std::invalid_argument unless `rgb` is CV_8UC3 and not empty. Shares the pixels of `rgb`.
Picture makePicture(const cv::Mat& rgb);

/// All four in [0, 1].
struct DirectDifferences {
  double boolean_rgb = 0.0;     ///< (4): share of pixels that differ in any channel
  double boolean_grey = 0.0;    ///< (4): share of grey pixels that differ
  double euclidean_rgb = 0.0;   ///< (6): mean of Σ_c (a_c − b_c)² / (3 · 255²)
  double euclidean_grey = 0.0;  ///< (5): mean of (a − b)² / 255²
};

/// One pass over both pictures. Sums are integers, so the result is exact to the last division and the same
/// on every machine. Throws std::invalid_argument where the sizes differ.
DirectDifferences directDifferences(const Picture& a, const Picture& b);

}  // namespace sunlit::evaluate
