/// Comparison of pictures by largest and mean difference, with a picture of the difference on failure. Link
/// sunlit_image.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "sunlit/image/files.h"
#include "sunlit/image/images.h"

namespace sunlit::test {

/// In levels of 0 … 255, over all pixels and channels. Zero demands equality.
struct PictureTolerance {
  int largest = 0;
  double mean = 0.0;
};

struct PictureDifference {
  int largest = 0;
  int x = 0, y = 0;  ///< where the largest is
  double mean = 0.0;
  image::Rgb8Image picture;  ///< absolute differences, 8 times amplified so that one level can be seen
};

/// Both of the same, non-zero size.
inline PictureDifference differenceOf(const image::Rgb8Image& actual, const image::Rgb8Image& expected) {
  PictureDifference difference;
  difference.picture = image::Rgb8Image(actual.width, actual.height);
  std::int64_t sum = 0;
  for (int y = 0; y < actual.height; ++y) {
    for (int x = 0; x < actual.width; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        const int d = std::abs(actual.at(x, y)[channel] - expected.at(x, y)[channel]);
        sum += d;
        if (d > difference.largest) {
          difference.largest = d;
          difference.x = x;
          difference.y = y;
        }
        difference.picture.at(x, y)[channel] = static_cast<std::uint8_t>(std::min(255, 8 * d));
      }
    }
  }
  difference.mean = static_cast<double>(sum) / static_cast<double>(actual.data.size());
  return difference;
}

/// EXPECT_TRUE(picturesMatch(actual, expected, {2, 0.1}, "noon")). On failure writes noon_actual.png,
/// noon_expected.png and noon_difference.png to SUNLIT_TEST_OUTPUT (default: the temporary folder) and says
/// where.
inline testing::AssertionResult picturesMatch(const image::Rgb8Image& actual,
                                              const image::Rgb8Image& expected,
                                              const PictureTolerance& tolerance, const std::string& name) {
  if (actual.width != expected.width || actual.height != expected.height || actual.data.empty()) {
    return testing::AssertionFailure() << name << ": size " << actual.width << "×" << actual.height
                                       << ", expected " << expected.width << "×" << expected.height;
  }
  const PictureDifference difference = differenceOf(actual, expected);
  if (difference.largest <= tolerance.largest && difference.mean <= tolerance.mean) {
    return testing::AssertionSuccess()
           << name << ": largest " << difference.largest << ", mean " << difference.mean;
  }
  const char* chosen = std::getenv("SUNLIT_TEST_OUTPUT");
  const std::string start = (chosen != nullptr ? std::string(chosen) + "/" : testing::TempDir()) + name;
  image::writePng(start + "_actual.png", actual);
  image::writePng(start + "_expected.png", expected);
  image::writePng(start + "_difference.png", difference.picture);
  return testing::AssertionFailure() << name << ": largest difference " << difference.largest << " at ("
                                     << difference.x << ", " << difference.y << "), allowed "
                                     << tolerance.largest << "; mean " << difference.mean << ", allowed "
                                     << tolerance.mean << "; see " << start << "_difference.png";
}

}  // namespace sunlit::test
