/// What the differences of pixels are made of.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace sunlit::evaluate {

/// Over all pixels of two images.
struct PixelSums {
  std::uint64_t squares = 0;  ///< Σ (a − b)² of all channels
  std::uint64_t unequal = 0;  ///< pixels that differ in any channel
  std::size_t pixels = 0;
};

/// Of two CV_8UC3 or two CV_8UC1. Sums are integers, so what is made of them is exact to the last division
/// and the same on every machine. Throws std::invalid_argument where the sizes differ.
PixelSums sumsOf(const cv::Mat& a, const cv::Mat& b);

}  // namespace sunlit::evaluate
