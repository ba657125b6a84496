// Rain in pictures by numbers on paper.
#include "sunlit/image/rain_streaks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sunlit::image {
namespace {

constexpr int kWidth = 320, kHeight = 240;
const Eigen::Vector3d kDown = Eigen::Vector3d::UnitY();

LinearImage grey(float luminance) {
  LinearImage picture(kWidth, kHeight);
  std::fill(picture.data.begin(), picture.data.end(), luminance);
  return picture;
}

DepthImage at(float depth_m) {
  DepthImage depth(kWidth, kHeight);
  std::fill(depth.data.begin(), depth.data.end(), depth_m);
  return depth;
}

/// Mean over `pictures` of the share of a white wall that rain takes away.
double taken(double mm_per_h, float wall_m, double exposure_s, int pictures) {
  const PinholeCamera camera = PinholeCamera::fromFieldOfView(kWidth, kHeight, Angle::degrees(60.0));
  const DepthImage depth = at(wall_m);
  double sum = 0.0;
  for (int i = 0; i < pictures; ++i) {
    RainStreaks rain{mm_per_h, 7, i, exposure_s};
    LinearImage picture = grey(1.0f);
    addRain(rain, {camera, kDown, depth}, &picture);
    for (const float value : picture.data) sum += 1.0 - static_cast<double>(value);
  }
  return sum / (3.0 * kWidth * kHeight * pictures);
}

/// ∫ over diameters above 1 mm of N(D) π/4 D², 1/m: what a metre of rain covers.
double shadowPerMetre(double mm_per_h) {
  const double slope = 4.1 * std::pow(mm_per_h, -0.21);
  double sum = 0.0;
  constexpr double kStep_mm = 0.001;
  for (double d = 1.0 + 0.5 * kStep_mm; d < 15.0; d += kStep_mm)
    sum += 8000.0 * std::exp(-slope * d) * 0.25 * kPi * d * d * 1e-6 * kStep_mm;
  return sum;
}

TEST(RainStreaks, TakeAwayWhatTheirShadowsCover) {
  for (const double mm_per_h : {10.0, 50.0}) {
    for (const double exposure_s : {0.0003, 0.005}) {
      // From 0.1 m on to the wall. A drop of 0.1 m distance is 3 px wide and there are few of them: 100
      // pictures leave some percent of chance.
      const double expected = 1.0 - std::exp(-shadowPerMetre(mm_per_h) * (4.0 - 0.1));
      EXPECT_NEAR(taken(mm_per_h, 4.0f, exposure_s, 100), expected, 0.12 * expected)
          << mm_per_h << " " << exposure_s;
    }
  }
}

TEST(RainStreaks, AreNoneBeforeWhatIsNearerOrWithoutRain) {
  EXPECT_EQ(taken(50.0, 0.05f, 0.001, 2), 0.0);
  EXPECT_EQ(taken(0.0, 4.0f, 0.001, 2), 0.0);
}

TEST(RainStreaks, OfOnePictureAreTheSameAgainAndOfAnotherOthers) {
  const PinholeCamera camera = PinholeCamera::fromFieldOfView(kWidth, kHeight, Angle::degrees(60.0));
  const DepthImage sky = at(std::numeric_limits<float>::quiet_NaN());
  const auto pictureOf = [&](std::uint64_t series, std::int64_t index) {
    LinearImage picture = grey(1.0f);
    addRain({30.0, series, index, 0.002}, {camera, kDown, sky}, &picture);
    return picture.data;
  };
  EXPECT_EQ(pictureOf(1, 5), pictureOf(1, 5));
  EXPECT_NE(pictureOf(1, 5), pictureOf(1, 6));
  EXPECT_NE(pictureOf(1, 5), pictureOf(2, 5));
}

}  // namespace
}  // namespace sunlit::image
