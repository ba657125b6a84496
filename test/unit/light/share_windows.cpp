// What pixels learn from the rays of their neighbours, and what must not be lost by it.
#include "light/picture/disc/share_windows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <random>

#include "light/picture/disc/disc_points.h"

namespace sunlit::light {
namespace {

constexpr int kSide = 48, kRays = ShareWindows::kRays;

PixelMap filled(const std::function<int(int, int)>& lit) {
  PixelMap map(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) map.at(x, y) = static_cast<std::uint8_t>(1 + lit(x, y));
  return map;
}

/// Calls `check` with each pixel of the middle tile, its own share and what the windows say.
void forEach(const PixelMap& map, const std::function<void(int, int, float, float)>& check) {
  constexpr int kStart = Surfaces::kTileSize;
  Tile tile;
  tile.x = tile.y = kStart;
  tile.width = tile.height = Surfaces::kTileSize;
  const ShareWindows windows(map, tile);
  for (int y = kStart; y < kStart + tile.height; ++y) {
    for (int x = kStart; x < kStart + tile.width; ++x) {
      const float own = static_cast<float>(map.at(x, y) - 1) / kRays;
      check(x, y, own, windows.share(x - kStart, y - kStart));
    }
  }
}

class EvenShade : public testing::TestWithParam<double> {};

TEST_P(EvenShade, IsFoundWithLittleNoise) {
  const double share = GetParam();
  std::mt19937 random(3);
  std::binomial_distribution<int> rays(kRays, share);
  double bias = 0.0, square = 0.0;
  int count = 0, all = 0;
  for (int times = 0; times < 20; ++times) {
    forEach(filled([&](int, int) { return rays(random); }), [&](int, int, float, float found) {
      ++all;
      if (found < 0.0f) return;
      const double error = static_cast<double>(found) - share;
      bias += error;
      square += error * error;
      ++count;
    });
  }
  const double of_one_ray = std::sqrt(share * (1.0 - share));
  EXPECT_GT(count, 0.95 * all);
  // Half of the noise that 16 rays of each pixel have, which cost four times as much.
  EXPECT_LT(std::sqrt(square / count), 0.5 * of_one_ray / 4.0);
  // Twenty pictures in which some 32 × 32 pixels have a say: three standard deviations.
  EXPECT_LT(std::abs(bias / count), 3.0 * of_one_ray / std::sqrt(20.0 * 32 * 32 * kRays));
}

INSTANTIATE_TEST_SUITE_P(FromDeepShadeToLight, EvenShade, testing::Values(0.03, 0.3, 0.5, 0.9));

TEST(ShareWindows, FollowAnEvenSlope) {
  std::mt19937 random(4);
  const auto slope = [](int x) { return 0.1 + 0.8 * x / (kSide - 1); };
  double bias = 0.0, square = 0.0;
  const PixelMap map =
      filled([&](int x, int) { return std::binomial_distribution<int>(kRays, slope(x))(random); });
  forEach(map, [&](int x, int, float own, float found) {
    const double error = static_cast<double>(found < 0.0f ? own : found) - slope(x);
    bias += error / 256.0;
    square += error * error / 256.0;
  });
  // Less than the noise of 16 rays a pixel, 12 % in the middle of the slope.
  EXPECT_LT(std::sqrt(square), 0.12);
  EXPECT_LT(std::abs(bias), 3.0 * 0.5 / std::sqrt(32.0 * 32 * kRays));
}

TEST(ShareWindows, KeepEdgesSharp) {
  for (const bool slanting : {false, true}) {
    const PixelMap map = filled([&](int x, int y) { return (slanting ? x + y / 2 : x) < 24 ? 0 : kRays; });
    forEach(map, [&](int x, int y, float own, float found) {
      // A pixel that touches an edge along its corner may take an eighth.
      EXPECT_NEAR(found < 0.0f ? own : found, own, 0.126f) << x << ' ' << y;
    });
  }
}

TEST(ShareWindows, DoNotWashOutAThinShadow) {
  const PixelMap map = filled([](int, int y) { return y == 24 ? kRays / 2 : kRays; });
  forEach(map, [](int x, int y, float own, float found) {
    EXPECT_NEAR(found < 0.0f ? own : found, own, 0.126f) << x << ' ' << y;
  });
}

TEST(ShareWindows, DoNotTakeFineShadowsForChance) {
  std::mt19937 random(5);
  int kept = 0;
  forEach(filled([&](int, int) { return random() % 2 == 0 ? 0 : kRays; }),
          [&](int, int, float, float found) { kept += found < 0.0f ? 1 : 0; });
  // Windows of nine pixels may be nearly all light or all dark by chance.
  EXPECT_GT(kept, 230);
}

TEST(DiscPoints, OfNeighboursCompleteEachOther) {
  const DiscPoints points(Eigen::Vector3f(0.6f, 0.0f, 0.8f), 0.0047f);
  const auto placeOf = [&](std::size_t x, std::size_t y, std::size_t i) {
    const Eigen::Vector3f& d = points.ofPixel(x, y)[i];
    return Eigen::Vector2f(Eigen::Vector2f(d.dot(points.across()), d.dot(points.up())) / std::tan(0.0047f));
  };
  const auto expectEven = [](const Eigen::Vector2f& sum, double squares, int count, double tolerance) {
    EXPECT_LT(sum.norm() / static_cast<float>(count), tolerance);
    EXPECT_NEAR(squares / count, 0.5, tolerance);  // the mean square of the radius of an even disc
  };
  for (std::size_t y = 0; y < 4; ++y) {
    for (std::size_t x = 0; x < 16; ++x) {
      Eigen::Vector2f quads = Eigen::Vector2f::Zero(), own = quads;
      double quads_square = 0.0, own_square = 0.0;
      for (std::size_t i = 0; i < DiscPoints::kPoints; ++i) {
        ASSERT_LE(placeOf(x, y, i).norm(), 1.0f);
        own += placeOf(x, y, i);
        own_square += static_cast<double>(placeOf(x, y, i).squaredNorm());
        const Eigen::Vector2f place = placeOf(x + i % 4, y, i / 4);
        quads += place;
        quads_square += static_cast<double>(place.squaredNorm());
      }
      // All points of one pixel, and the quads of four in a row, are the same spiral, whose mean is off the
      // middle by 3 % of the radius.
      expectEven(own, own_square, 16, 0.04);
      expectEven(quads, quads_square, 16, 0.04);
    }
  }
}

}  // namespace
}  // namespace sunlit::light
