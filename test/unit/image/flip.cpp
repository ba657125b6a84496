// The perceptual difference: known values, symmetry, bounds.
#include "sunlit/image/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sunlit::image {
namespace {

LinearImage even(float r, float g, float b, int size = 48) {
  LinearImage image(size, size);
  for (std::size_t i = 0; i < image.data.size(); i += 3) {
    image.data[i] = r;
    image.data[i + 1] = g;
    image.data[i + 2] = b;
  }
  return image;
}

/// Squares of `square` px, of luminance `low` and `high` in turn.
LinearImage checkered(int square, float low, float high, int size = 48) {
  LinearImage image(size, size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) std::fill_n(image.at(x, y), 3, (x / square + y / square) % 2 ? high : low);
  }
  return image;
}

/// Some picture of many values and colours.
LinearImage varied(float scale, int size = 48) {
  LinearImage image(size, size);
  for (std::size_t i = 0; i < image.data.size(); ++i)
    image.data[i] = scale * static_cast<float>(0.5 + 0.5 * std::sin(0.37 * static_cast<double>(i * i % 997)));
  return image;
}

TEST(Flip, OfBlackAndWhiteIsThePublishedValue) {
  // By hand: HyAB 100, ^0.7 25.12; largest difference, green to blue, 203.3 ^0.7 = 41.28, knee at 0.4 of
  // that: 0.95 + 0.05 (25.12 − 16.51) / (41.28 − 16.51). The authors give 0.967.
  const Picture<float, 1> result = flip(even(0.0f, 0.0f, 0.0f), even(1.0f, 1.0f, 1.0f));
  for (const float value : result.data) EXPECT_NEAR(value, 0.9674f, 0.0005f);
}

TEST(Flip, OfTwoGreysFollowsTheirLightness) {
  // L* of 0.5 is 76.07 and of 0.4 is 69.47: 6.60 ^0.7 = 3.747, times 0.95 / 16.51.
  const Picture<float, 1> result = flip(even(0.5f, 0.5f, 0.5f), even(0.4f, 0.4f, 0.4f));
  for (const float value : result.data) EXPECT_NEAR(value, 0.2156f, 0.001f);
}

TEST(Flip, OfGreenAndBlueIsTheLargest) {
  const Picture<float, 1> result = flip(even(0.0f, 1.0f, 0.0f), even(0.0f, 0.0f, 1.0f));
  EXPECT_NEAR(meanOf(result), 1.0, 1e-5);
}

TEST(Flip, OfAPictureAndItselfIsNone) {
  EXPECT_EQ(meanOf(flip(varied(1.0f), varied(1.0f))), 0.0);
  EXPECT_EQ(meanOf(hdrFlip(varied(1e4f), varied(1e4f))), 0.0);
}

TEST(Flip, IsSymmetricAndWithinZeroAndOne) {
  const LinearImage a = varied(1.0f), b = checkered(5, 0.1f, 0.8f);
  const Picture<float, 1> there = flip(a, b), back = flip(b, a);
  EXPECT_EQ(there.data, back.data);
  for (const float value : there.data) {
    EXPECT_GE(value, 0.0f);
    EXPECT_LE(value, 1.0f);
  }
}

TEST(Flip, HardlySeesWhatIsFinerThanTheEye) {
  const LinearImage grey = even(0.45f, 0.45f, 0.45f);
  // At 67 pixels a degree a checkerboard of single pixels is at the limit of sight; one of 8 pixels is not.
  const double fine = meanOf(flip(grey, checkered(1, 0.4f, 0.5f)));
  const double coarse = meanOf(flip(grey, checkered(8, 0.4f, 0.5f)));
  EXPECT_LT(fine, 0.2 * coarse);
  EXPECT_GT(coarse, 0.05);
}

TEST(Flip, SeesAnEdgeMoreThanItsColours) {
  // Where only one picture has an edge, the difference of colour is raised to a power below one.
  LinearImage halves = even(0.4f, 0.4f, 0.4f);
  for (int y = 0; y < 48; ++y) {
    for (int x = 24; x < 48; ++x) std::fill_n(halves.at(x, y), 3, 0.5f);
  }
  const Picture<float, 1> result = flip(even(0.4f, 0.4f, 0.4f), halves);
  EXPECT_GT(*result.at(25, 24), *result.at(46, 24));
  EXPECT_LT(*result.at(2, 24), 0.01f);
}

TEST(HdrFlip, DoesNotDependOnTheUnit) {
  LinearImage dim = varied(1.0f), other = checkered(5, 0.1f, 0.8f);
  LinearImage bright = dim, other_bright = other;
  for (float& value : bright.data) value *= 4096.0f;
  for (float& value : other_bright.data) value *= 4096.0f;
  EXPECT_NEAR(meanOf(hdrFlip(dim, other)), meanOf(hdrFlip(bright, other_bright)), 1e-4);
}

TEST(HdrFlip, FindsADifferenceThatOneExposureWouldHide) {
  // A bright half, in which the pictures differ beyond white for an exposure of the dark half.
  LinearImage reference = even(1.0f, 1.0f, 1.0f), test = reference;
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 48; ++x) {
      std::fill_n(reference.at(x, y), 3, 1000.0f);
      std::fill_n(test.at(x, y), 3, 2000.0f);
    }
  }
  const Picture<float, 1> result = hdrFlip(reference, test);
  EXPECT_GT(*result.at(24, 3), 0.1f);
  EXPECT_LT(*result.at(24, 45), 0.01f);
  for (const float value : result.data) EXPECT_LE(value, 1.0f);
}

TEST(HdrFlip, TakesBlackAndNanForBlack) {
  LinearImage broken = even(0.0f, 0.0f, 0.0f);
  broken.data[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(meanOf(hdrFlip(broken, even(0.0f, 0.0f, 0.0f))), 0.0);
}

TEST(Flip, RefusesPicturesOfDifferentSize) {
  EXPECT_THROW(flip(even(0, 0, 0, 8), even(0, 0, 0, 9)), std::invalid_argument);
  EXPECT_THROW(hdrFlip(even(0, 0, 0, 8), even(0, 0, 0, 9)), std::invalid_argument);
  FlipOptions options;
  options.pixels_per_degree = 5.0;
  EXPECT_THROW(flip(even(0, 0, 0), even(0, 0, 0), options), std::invalid_argument);
}

}  // namespace
}  // namespace sunlit::image
