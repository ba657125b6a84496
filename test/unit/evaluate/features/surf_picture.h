// A picture with detail at many scales, made in whole numbers so that every machine makes the same one.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace sunlit::test {

// A random grid every `wavelength` px, interpolated bilinearly, is added to `sum` with the given amplitude.
inline void addNoise(cv::Mat1i& sum, int wavelength, int amplitude) {
  auto state = static_cast<std::uint32_t>(wavelength);
  const int cols = sum.cols / wavelength + 2;
  std::vector<int> grid(static_cast<std::size_t>(cols) * (sum.rows / wavelength + 2));
  for (int& value : grid) {
    state = 1664525u * state + 1013904223u;  // Numerical Recipes' generator
    value = amplitude * (static_cast<int>(state >> 24) - 128);
  }
  for (int y = 0; y < sum.rows; ++y) {
    for (int x = 0; x < sum.cols; ++x) {
      const int* at = grid.data() + (y / wavelength) * cols + x / wavelength;
      const int fx = x % wavelength, fy = y % wavelength;
      const int top = at[0] * (wavelength - fx) + at[1] * fx;
      const int bottom = at[cols] * (wavelength - fx) + at[cols + 1] * fx;
      sum(y, x) += (top * (wavelength - fy) + bottom * fy) / (wavelength * wavelength);
    }
  }
}

inline cv::Mat1b madePicture(int cols, int rows) {
  cv::Mat1i sum = cv::Mat1i::zeros(rows, cols);
  for (int wavelength = 3; wavelength <= 48; wavelength *= 2) addNoise(sum, wavelength, 12 + wavelength / 4);
  cv::Mat1b picture(rows, cols);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < cols; ++x) picture(y, x) = cv::saturate_cast<std::uint8_t>(128 + sum(y, x) / 60);
  }
  return picture;
}

}  // namespace sunlit::test
