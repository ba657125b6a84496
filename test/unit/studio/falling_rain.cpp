// Streaks of rain and the air's share of it, which are made in different places, side by side.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sunlit/image/rain_streaks.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/sky/weather.h"

namespace sunlit::studio {
namespace {

struct Spread {
  double mean, deviation;  ///< of what streaks take from a white wall
};

/// Of all pixels of so many pictures of a wall 4 m away.
Spread taken(double mm_per_h, double exposure_s, int pictures) {
  const image::PinholeCamera camera = image::PinholeCamera::fromFieldOfView(320, 240, Angle::degrees(60.0));
  const image::Lens lens(camera, {});
  const Eigen::Isometry3d level(linkFromOptical());
  image::DepthImage depth(camera.width, camera.height);
  std::fill(depth.data.begin(), depth.data.end(), 4.0f);
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < pictures; ++i) {
    image::LinearImage picture(camera.width, camera.height);
    std::fill(picture.data.begin(), picture.data.end(), 1.0f);
    image::RainStreaks rain;
    rain.mm_per_h = mm_per_h;
    rain.seed = 11;
    rain.moment = i;
    rain.exposure_s = exposure_s;
    image::addRain(rain, {lens, level, Motion(), depth}, &picture);
    for (std::size_t p = 0; p < picture.data.size(); p += 3) {
      const double lost = 1.0 - static_cast<double>(picture.data[p]);
      sum += lost;
      squares += lost * lost;
    }
  }
  const double count = static_cast<double>(camera.width) * camera.height * pictures;
  return {sum / count, std::sqrt(squares / count - sum / count * sum / count)};
}

TEST(FallingRain, StreaksFadeWithTheRootOfTheExposure) {
  for (const double mm_per_h : {10.0, 50.0}) {
    const Spread brief = taken(mm_per_h, 0.004, 60), fourfold = taken(mm_per_h, 0.016, 60);
    // A streak k drops long has ends, which take 1 / (3 k) of the square: at 4 ms it is some 15 drops long.
    EXPECT_NEAR(brief.deviation / fourfold.deviation, 2.0, 0.1) << mm_per_h;
  }
}

TEST(FallingRain, StreaksTakeTheirShareOfWhatRainTakes) {
  // Drops of 1 mm up have the share e^−Λ (1 + Λ + Λ²/2) of all drops' shadows, Λ = 4.1 R^−0.21 /mm: 0.537 at
  // 10 mm/h. Those of the first 4 m but 0.1 are drawn.
  for (const double mm_per_h : {10.0, 50.0}) {
    const double slope = 4.1 * std::pow(mm_per_h, -0.21);
    const double share = std::exp(-slope) * (1.0 + slope + 0.5 * slope * slope);
    const double expected = 1.0 - std::exp(-sky::rainPerMetre(mm_per_h) * share * 3.9);
    const double mean = taken(mm_per_h, 0.008, 100).mean;
    // By chance of some thousand drops, measured within 1 %.
    EXPECT_NEAR(mean, expected, 0.05 * expected) << mm_per_h;
  }
}

}  // namespace
}  // namespace sunlit::studio
