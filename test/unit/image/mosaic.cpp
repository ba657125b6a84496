// One colour a pixel, and the other two found again.
#include "sunlit/image/mosaic.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "sunlit/image/exposure.h"
#include "sunlit/image/sensor_noise.h"

namespace sunlit::image {
namespace {

constexpr std::array<MosaicPattern, 4> kPatterns = {MosaicPattern::kRggb, MosaicPattern::kBggr,
                                                    MosaicPattern::kGrbg, MosaicPattern::kGbrg};
constexpr std::array<Demosaic, 3> kWays = {Demosaic::kBilinear, Demosaic::kVng, Demosaic::kEdgeAware};

Rgb8Image even(const std::array<std::uint8_t, 3>& colour, int width = 64, int height = 48) {
  Rgb8Image picture(width, height);
  for (std::size_t i = 0; i < picture.data.size(); ++i) picture.data[i] = colour[i % 3];
  return picture;
}

TEST(Mosaic, OfNoPatternLeavesEveryBit) {
  const Rgb8Image picture = even({1, 200, 30});
  EXPECT_EQ(throughMosaic(picture, {}).data, picture.data);
}

TEST(Mosaic, LeavesGreyAsItIs) {
  for (const MosaicPattern pattern : kPatterns) {
    for (const Demosaic way : kWays) {
      for (int level = 0; level < 256; level += 15) {
        const auto grey = static_cast<std::uint8_t>(level);
        const Rgb8Image picture = even({grey, grey, grey}, 17, 16);
        EXPECT_EQ(throughMosaic(picture, {pattern, way}).data, picture.data) << level;
      }
    }
  }
}

TEST(Mosaic, LeavesAnEvenColourAsItIs) {
  // The pattern and OpenCV's name for it fit, or red and blue would change places.
  for (const MosaicPattern pattern : kPatterns) {
    for (const Demosaic way : kWays) {
      const Rgb8Image picture = even({200, 90, 20});
      const Rgb8Image seen = throughMosaic(picture, {pattern, way});
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(seen.at(30, 21)[c], picture.at(30, 21)[c], 1)
            << static_cast<int>(pattern) << " " << static_cast<int>(way);
    }
  }
}

TEST(Mosaic, LeavesWhatASensorSeesAtItsPixel) {
  // The value of a pixel's own colour stays, wherever it is, whatever the two others become.
  for (const MosaicPattern pattern : kPatterns) {
    for (const Demosaic way : kWays) {
      for (const auto& [width, height] : {std::pair{64, 48}, {33, 17}}) {
        Rgb8Image picture(width, height);
        for (std::size_t i = 0; i < picture.data.size(); ++i)
          picture.data[i] = static_cast<std::uint8_t>(i * i * 31 % 251);
        const Rgb8Image seen = throughMosaic(picture, {pattern, way});
        int kept = 0;
        for (int y = 4; y < height - 4; ++y) {
          for (int x = 4; x < width - 4; ++x) {
            bool is_own = false;
            for (int c = 0; c < 3; ++c) is_own |= seen.at(x, y)[c] == picture.at(x, y)[c];
            kept += is_own ? 1 : 0;
          }
        }
        EXPECT_EQ(kept, (width - 8) * (height - 8))
            << static_cast<int>(pattern) << " " << static_cast<int>(way);
      }
    }
  }
}

TEST(Mosaic, KeepsOfEachPixelTheColourThatItsSensorSees) {
  // Red alone where only a red sensor sees it stays; where a green or blue one stands it is lost.
  Rgb8Image picture = even({0, 0, 0});
  picture.at(20, 20)[0] = 255;
  picture.at(31, 20)[0] = 255;
  const Rgb8Image seen = throughMosaic(picture, {MosaicPattern::kRggb, Demosaic::kBilinear});
  EXPECT_EQ(seen.at(20, 20)[0], 255);
  EXPECT_EQ(seen.at(21, 20)[0], 128);  // half way to the next red one
  EXPECT_EQ(seen.at(31, 20)[0], 0);
}

TEST(Mosaic, KeepsThePhotonNoiseOfEachPixel) {
  // A grey that is half of saturation, 500 electrons of 1,000 and no read noise: of the pixels that see
  // green, the linear values have a variance of 1 / 500 of the mean squared. 8 bits add 1/12 of a level,
  // which here is 0.5 % of the light: 2e-6. Of 76,800 values the variance is known to 0.5 % (1 / sqrt(n/2)).
  constexpr double kEv100 = 10.0;
  NoiseOptions noise;
  noise.full_well_e = 1000.0;
  noise.read_e = 0.0;
  LinearImage light(480, 320);
  for (float& value : light.data) value = static_cast<float>(0.5 * saturationLuminance(kEv100));
  addSensorNoise(kEv100, noise, {}, &light);
  const Rgb8Image developed = develop(light, kEv100);
  const Rgb8Image seen = throughMosaic(developed, {MosaicPattern::kRggb, Demosaic::kBilinear});
  double sum = 0.0, squares = 0.0;
  int count = 0;
  for (int y = 2; y < 318; ++y) {
    for (int x = 2; x < 478; ++x) {
      if ((x + y) % 2 == 0) continue;  // red or blue
      ASSERT_EQ(seen.at(x, y)[1], developed.at(x, y)[1]);
      const double display = seen.at(x, y)[1] / 255.0;
      const double linear = std::pow((display + 0.055) / 1.055, 2.4);
      sum += linear;
      squares += linear * linear;
      ++count;
    }
  }
  const double mean = sum / count, variance = squares / count - mean * mean;
  EXPECT_NEAR(mean, 0.5, 0.002);
  EXPECT_NEAR(variance / (mean * mean), 1.0 / 500.0 + 2e-6, 0.00005);
}

TEST(Mosaic, FoundAgainIsSmootherThanWhatIsSeen) {
  // Bilinear red of a pixel between two red ones has half the variance of theirs.
  Rgb8Image picture = even({128, 128, 128}, 400, 300);
  NoiseOptions noise;
  noise.full_well_e = 2000.0;
  noise.read_e = 0.0;
  LinearImage light(400, 300);
  for (float& value : light.data) value = static_cast<float>(0.3 * saturationLuminance(10.0));
  addSensorNoise(10.0, noise, {}, &light);
  const Rgb8Image seen = throughMosaic(develop(light, 10.0), {MosaicPattern::kRggb, Demosaic::kBilinear});
  const auto variance = [&](int first_x) {
    double sum = 0.0, squares = 0.0, count = 0.0;
    for (int y = 2; y < 298; y += 2) {
      for (int x = 2 + first_x; x < 396; x += 2) {
        const double value = seen.at(x, y)[0];
        sum += value;
        squares += value * value;
        count += 1.0;
      }
    }
    return squares / count - sum * sum / (count * count);
  };
  // Both known to 1.2 % (n = 29,156), and rounding to whole levels adds 1/12 of 8 or so.
  EXPECT_NEAR(variance(1) / variance(0), 0.5, 0.04);
}

}  // namespace
}  // namespace sunlit::image
