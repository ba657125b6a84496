// A lens that is not sharp, on paper.
#include "sunlit/image/lens_blur.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>

#include "support/message_of.h"

namespace sunlit::image {
namespace {

LinearImage pointAt(int x, int y, int width = 64, int height = 48) {
  LinearImage picture(width, height);
  for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = 1e6F * static_cast<float>(c + 1);
  return picture;
}

double sumOf(const LinearImage& picture, int channel) {
  double sum = 0.0;
  for (std::size_t i = static_cast<std::size_t>(channel); i < picture.data.size(); i += 3)
    sum += picture.data[i];
  return sum;
}

TEST(LensBlur, OfNothingLeavesEveryBit) {
  LinearImage picture = pointAt(3, 3);
  picture.data[0] = -1.0F;
  const LinearImage before = picture;
  blur({}, &picture);
  EXPECT_EQ(picture.data, before.data);
}

TEST(LensBlur, KeepsTheLightWhereverItIs) {
  for (const auto& [x, y] : {std::pair(32, 24), std::pair(0, 0), std::pair(63, 20), std::pair(5, 47)}) {
    for (const double sigma : {0.3, 1.0, 10.0}) {
      LinearImage picture = pointAt(x, y);
      blur({sigma}, &picture);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(sumOf(picture, c), 1e6 * (c + 1), 10.0 * (c + 1)) << sigma;
    }
  }
}

TEST(LensBlur, SpreadsAPointByItsVarianceAndThatOfAPixel) {
  // A Gaussian over squares of a pixel is as much wider as they are: 1/12. Of one as narrow as half a pixel
  // sums over pixels are off by e^(−2 π² σ²), 0.7 %, times the square of a pixel; of wider ones what lies
  // beyond 4 σ is left out, 0.1 %.
  for (const auto& [sigma, tolerance] :
       {std::pair(0.5, 0.01), std::pair(1.0, 0.002), std::pair(2.0, 0.008)}) {
    LinearImage picture = pointAt(32, 24);
    blur({sigma}, &picture);
    double across = 0.0, down = 0.0;
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) {
        across += picture.at(x, y)[0] * (x - 32.0) * (x - 32.0) / 1e6;
        down += picture.at(x, y)[0] * (y - 24.0) * (y - 24.0) / 1e6;
      }
    }
    const double expected = sigma * sigma + 1.0 / 12.0;
    EXPECT_NEAR(across, expected, tolerance) << sigma;
    EXPECT_NEAR(down, expected, tolerance) << sigma;
  }
}

TEST(LensBlur, MakesAnEdgeAsWideAsAGaussianDoes) {
  constexpr double kSigma = 4.0;
  LinearImage picture(128, 16);
  for (int y = 0; y < 16; ++y)
    for (int x = 64; x < 128; ++x) picture.at(x, y)[1] = 1000.0F;
  blur({kSigma}, &picture);
  // Its integral from the edge, at the left side of pixel 64, to the pixels' middles; mean of a square: 1 in
  // 1000.
  for (int x = 54; x < 74; ++x) {
    const double expected = 500.0 * (1.0 + std::erf((x + 0.5 - 64.0) / (std::sqrt(2.0) * kSigma)));
    EXPECT_NEAR(picture.at(x, 8)[1], expected, 1.0) << x;
  }
}

TEST(LensBlur, HasTheSameBitsForAnyThreadCount) {
  LinearImage parallel = pointAt(10, 10), alone = parallel;
  blur({1.3}, &parallel);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  blur({1.3}, &alone);
  EXPECT_EQ(alone.data, parallel.data);
}

TEST(LensBlur, OfWhatIsNoNumberIsOne) {
  LinearImage picture = pointAt(10, 10);
  picture.data[3] = std::numeric_limits<float>::quiet_NaN();
  picture.data[6] = std::numeric_limits<float>::infinity();
  blur({1.0}, &picture);
  for (const float value : picture.data) ASSERT_TRUE(std::isfinite(value));
}

TEST(BlurOptions, BadValuesAreNamedWithTheirRange) {
  EXPECT_EQ(messageOf([] { validate(BlurOptions{}); }), "");
  EXPECT_EQ(messageOf([] { validate(BlurOptions{11.0}); }), "sigma is 11, but must be from 0 to 10 px");
}

}  // namespace
}  // namespace sunlit::image
