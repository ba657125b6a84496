// What is taken together of a picture's pixels is as each of them alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "light/picture/disc/pixel_map.h"
#include "light/picture/sky/sky_pixel.h"
#include "sunlit/quantity/angle.h"
#include "support/usual_air.h"

namespace sunlit::light {
namespace {

Tile tileAt(int x, int y, int width, int height) {
  Tile tile;
  tile.x = x;
  tile.y = y;
  tile.width = width;
  tile.height = height;
  tile.sky.assign(static_cast<std::size_t>(width * height), 4);
  return tile;
}

/// A level camera that looks east with a field of view of 60°, half of it below the horizon.
Surfaces levelCamera() {
  Surfaces surfaces;
  surfaces.width = 160;
  surfaces.height = 90;  // the last row of tiles is not whole
  surfaces.samples_per_pixel = 4;
  const float pixel = 2.0f * std::tan(static_cast<float>(30.0 * kRadPerDeg)) / 160.0f;
  surfaces.pixel_right = {0.0f, -pixel, 0.0f};
  surfaces.pixel_down = {0.0f, 0.0f, -pixel};
  surfaces.pixel_origin =
      Eigen::Vector3f::UnitX() - 79.5f * surfaces.pixel_right - 44.5f * surfaces.pixel_down;
  for (int y = 0; y < 90; y += 16)
    for (int x = 0; x < 160; x += 16) surfaces.tiles.push_back(tileAt(x, y, 16, std::min(16, 90 - y)));
  return surfaces;
}

TEST(SkyInView, IsTheSameInCellsAsPixelByPixel) {
  const Surfaces surfaces = levelCamera();
  for (const double sun_deg : {8.0, -5.0}) {
    const sky::Daylight day =
        sky::usualAir().daylight({Direction(Azimuth::degrees(80.0), Angle::degrees(sun_deg)), 1.0});
    const SkyPixel sky(surfaces, day);
    image::LinearImage image(surfaces.width, surfaces.height);
    for (const Tile& tile : surfaces.tiles) sky.addTo(tile, &image);
    for (int y = 0; y < surfaces.height; ++y) {
      for (int x = 0; x < surfaces.width; ++x) {
        const Eigen::Array3f alone = sky.luminance(x, y);
        const Eigen::Map<const Eigen::Array3f> here(image.at(x, y));
        // Within 0.1 % in the middle of a cell; twice that where it bends along one side and back along the
        // other.
        ASSERT_LE(((here - alone).abs() / alone.max(1e-9f)).maxCoeff(), 0.002f) << x << ' ' << y;
      }
    }
  }
}

TEST(PixelMap, JoinsTheNeighboursOfEveryPixelAlsoAtTheEdgesOfThePicture) {
  constexpr int kWidth = 37, kHeight = 29;
  PixelMap marks(kWidth, kHeight), ones(kWidth, kHeight);
  std::mt19937 random(5);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      marks.at(x, y) = random() % 8 == 0 ? static_cast<std::uint8_t>(1 + random() % 3) : 0;
      ones.at(x, y) = random() % 3 == 0 ? 1 : 0;
    }
  }
  const auto inside = [](int x, int y) { return x >= 0 && y >= 0 && x < kWidth && y < kHeight; };
  for (int top = 0; top < kHeight; top += 16) {
    for (int left = 0; left < kWidth; left += 16) {
      const Tile tile = tileAt(left, top, std::min(16, kWidth - left), std::min(16, kHeight - top));
      const PixelMap::OfTile bits = marks.bitsAround(tile), count = ones.countAround(tile);
      for (int y = top; y < top + tile.height; ++y) {
        for (int x = left; x < left + tile.width; ++x) {
          int all = 0, sum = 0;
          for (int j = -2; j <= 2; ++j) {
            for (int i = -2; i <= 2; ++i) {
              if (!inside(x + i, y + j)) continue;
              all |= marks.at(x + i, y + j);
              if (std::abs(i) <= 1 && std::abs(j) <= 1) sum += ones.at(x + i, y + j);
            }
          }
          const auto row = static_cast<std::size_t>(y - top), column = static_cast<std::size_t>(x - left);
          ASSERT_EQ(bits[row][column], all) << x << ' ' << y;
          ASSERT_EQ(count[row][column], sum) << x << ' ' << y;
        }
      }
    }
  }
}

}  // namespace
}  // namespace sunlit::light
