#include "sunlit/image/sensor_noise.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "sunlit/image/exposure.h"
#include "support/message_of.h"

namespace sunlit::image {
namespace {

LinearImage even(int width, int height, double luminance) {
  LinearImage image(width, height);
  for (float& value : image.data) value = static_cast<float>(luminance);
  return image;
}

NoiseOptions switchedOn() {
  NoiseOptions options;
  options.enabled = true;
  return options;
}

LinearImage noisy(double luminance, double ev100, const NoiseOptions& options, const PictureName& name = {}) {
  LinearImage image = even(200, 150, luminance);
  addSensorNoise(ev100, options, name, &image);
  return image;
}

struct Moments {
  double mean = 0.0, variance = 0.0;
};

Moments momentsOf(const LinearImage& image) {
  Moments moments;
  const auto n = static_cast<double>(image.data.size());
  for (const float value : image.data) moments.mean += value / n;
  for (const float value : image.data) moments.variance += std::pow(value - moments.mean, 2) / (n - 1.0);
  return moments;
}

TEST(SensorNoise, KeepsTheMeanAndHasTheVarianceOfShotsAndReading) {
  const NoiseOptions options = switchedOn();
  for (const double ev100 : {12.0, 5.9, 0.0, -6.0}) {
    const double saturation = saturationLuminance(ev100);
    const double unit = saturation / electronsAtSaturation(ev100, options);  // cd/m² an electron
    for (const double part : {0.0, 0.01, 0.18, 0.9}) {
      const double electrons = part * saturation / unit;
      const double variance = electrons + options.read_e * options.read_e;
      const Moments found = momentsOf(noisy(part * saturation, ev100, options));
      // 90,000 values: the mean is known to 1/300 of a standard deviation, the variance to √(2/n) = 0.5 %.
      EXPECT_NEAR(found.mean / unit, electrons, 4.0 / 300.0 * std::sqrt(variance)) << ev100 << ' ' << part;
      EXPECT_NEAR(found.variance / (unit * unit), variance, 0.02 * variance) << ev100 << ' ' << part;
    }
  }
}

TEST(SensorNoise, FewElectronsComeInWholeNumbersByPoisson) {
  NoiseOptions options = switchedOn();
  options.read_e = 0.0;
  const double ev100 = 0.0;
  const double unit = saturationLuminance(ev100) / electronsAtSaturation(ev100, options);
  const LinearImage image = noisy(2.0 * unit, ev100, options);
  int counts[12] = {};
  for (const float value : image.data) {
    const double electrons = value / unit;
    ASSERT_NEAR(electrons, std::round(electrons), 1e-5 * (1.0 + electrons));
    ++counts[std::min(11, static_cast<int>(std::lround(electrons)))];
  }
  double probability = std::exp(-2.0);
  for (int k = 0; k < 8; ++k) {
    const double expected = probability * 90000.0;
    EXPECT_NEAR(counts[k], expected, 4.0 * std::sqrt(expected)) << k;  // 4 standard deviations
    probability *= 2.0 / (k + 1);
  }
}

TEST(SensorNoise, GainRisesOnlyWhereTheShutterIsAtItsEnd) {
  NoiseOptions options;
  options.full_well_e = 16000.0;
  options.gain_ev100 = 6.0;
  EXPECT_EQ(electronsAtSaturation(14.0, options), 16000.0);
  EXPECT_EQ(electronsAtSaturation(6.0, options), 16000.0);
  EXPECT_EQ(electronsAtSaturation(2.0, options), 1000.0);
  EXPECT_EQ(electronsAtSaturation(-8.0, options), 16000.0 / 16384.0);
}

TEST(SensorNoise, HasTheSameBitsForAnyThreadCount) {
  const LinearImage parallel = noisy(0.5, 0.0, switchedOn());
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(noisy(0.5, 0.0, switchedOn()).data, parallel.data);
}

/// Correlation of two pictures of one mean.
double correlation(const LinearImage& a, const LinearImage& b) {
  const Moments of_a = momentsOf(a), of_b = momentsOf(b);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.data.size(); ++i)
    sum += (a.data[i] - of_a.mean) * (b.data[i] - of_b.mean) / static_cast<double>(a.data.size());
  return sum / std::sqrt(of_a.variance * of_b.variance);
}

TEST(SensorNoise, OfOtherSeedsPicturesSeriesAndDrivesIsIndependent) {
  const LinearImage first = noisy(0.5, 0.0, switchedOn(), {7, "h04"});
  EXPECT_EQ(noisy(0.5, 0.0, switchedOn(), {7, "h04"}).data, first.data);
  NoiseOptions other_seed = switchedOn();
  other_seed.seed = 1;
  // Of 90,000 independent pairs: 0 ± 0.0033.
  EXPECT_NEAR(correlation(first, noisy(0.5, 0.0, other_seed, {7, "h04"})), 0.0, 0.014);
  EXPECT_NEAR(correlation(first, noisy(0.5, 0.0, switchedOn(), {8, "h04"})), 0.0, 0.014);
  EXPECT_NEAR(correlation(first, noisy(0.5, 0.0, switchedOn(), {7, "h12"})), 0.0, 0.014);
  EXPECT_NEAR(correlation(first, noisy(0.5, 0.0, switchedOn(), {7, "h04", "beside"})), 0.0, 0.014);
}

TEST(SensorNoise, OfNeighbouringValuesIsIndependent) {
  const LinearImage image = noisy(0.5, 0.0, switchedOn());
  LinearImage shifted = image;
  for (std::size_t step : {std::size_t{1}, std::size_t{3}, std::size_t{600}}) {  // channel, pixel, row
    for (std::size_t i = 0; i < image.data.size(); ++i)
      shifted.data[i] = image.data[(i + step) % image.data.size()];
    EXPECT_NEAR(correlation(image, shifted), 0.0, 0.014) << step;  // 0 ± 0.0033
  }
}

TEST(SensorNoise, WhatIsNoLightIsBlack) {
  NoiseOptions options = switchedOn();
  options.read_e = 0.0;
  LinearImage image = even(16, 16, std::numeric_limits<double>::quiet_NaN());
  image.data[0] = -5.0F;
  image.data[1] = std::numeric_limits<float>::infinity();
  addSensorNoise(0.0, options, {}, &image);
  EXPECT_EQ(image.data[0], 0.0F);
  EXPECT_GT(image.data[1], 1e11F);
  EXPECT_EQ(image.data[2], 0.0F);
}

std::string messageOf(const NoiseOptions& options) {
  return sunlit::messageOf([&] { validate(options); });
}

TEST(NoiseOptions, BadValuesAreNamedWithTheirRange) {
  EXPECT_EQ(messageOf({}), "");
  NoiseOptions options;
  options.full_well_e = 50.0;
  EXPECT_EQ(messageOf(options), "full_well_e is 50, but must be from 100 to 1000000 electrons");
  options = {};
  options.read_e = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(messageOf(options), "read_e is nan, but must be from 0 to 1000 electrons");
  options = {};
  options.gain_ev100 = 25.0;
  EXPECT_EQ(messageOf(options), "gain_ev100 is 25, but must be from -16 to 24 EV");
  options = {};
  options.seed = -1;
  EXPECT_EQ(messageOf(options), "seed is -1, but must be from 0 to 2147483647");
}

}  // namespace
}  // namespace sunlit::image
