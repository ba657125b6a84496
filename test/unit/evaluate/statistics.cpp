#include "sunlit/evaluate/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace sunlit::evaluate {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// x_t = correlation · x_{t−1} + noise, stationary from the start, mean 0.
std::vector<double> autoregressive(std::size_t n, double correlation, std::mt19937_64& generator) {
  std::normal_distribution<double> noise;
  std::vector<double> series(n);
  double x = noise(generator) / std::sqrt(1.0 - correlation * correlation);
  for (double& value : series) {
    value = x;
    x = correlation * x + noise(generator);
  }
  return series;
}

double shareOfIntervalsThatHoldTheMean(std::size_t n, double correlation, int trials) {
  std::mt19937_64 generator(11);
  int held = 0;
  for (int i = 0; i < trials; ++i) {
    const Statistics s = statisticsOf(autoregressive(n, correlation, generator));
    held += s.ci_low <= 0.0 && 0.0 <= s.ci_high ? 1 : 0;
  }
  return static_cast<double>(held) / trials;
}

TEST(Statistics, AreThoseOfATextbookExample) {
  const Statistics s = statisticsOf({2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_EQ(s.n, 8u);
  EXPECT_EQ(s.undefined, 0u);
  EXPECT_DOUBLE_EQ(s.mean, 5.0);
  EXPECT_DOUBLE_EQ(s.sd, std::sqrt(32.0 / 7.0));
  EXPECT_LT(s.ci_low, s.mean);
  EXPECT_GT(s.ci_high, s.mean);
}

TEST(Statistics, KeepUndefinedValuesOutAndCountThem) {
  const Statistics s = statisticsOf({kNaN, 1.0, kNaN, 3.0});
  EXPECT_EQ(s.n, 2u);
  EXPECT_EQ(s.undefined, 2u);
  EXPECT_EQ(s.mean, 2.0);
  EXPECT_DOUBLE_EQ(s.sd, std::sqrt(2.0));
}

TEST(Statistics, OfNothingAreUndefined) {
  const Statistics none = statisticsOf({kNaN});
  EXPECT_EQ(none.n, 0u);
  EXPECT_EQ(none.undefined, 1u);
  EXPECT_TRUE(std::isnan(none.mean) && std::isnan(none.sd) && std::isnan(none.ci_low) &&
              std::isnan(none.ci_high));
  const Statistics one = statisticsOf({0.25});
  EXPECT_EQ(one.mean, 0.25);
  EXPECT_TRUE(std::isnan(one.sd) && std::isnan(one.ci_low));
}

TEST(Statistics, OfEqualValuesAreExact) {
  // 0.1 has no exact double, and a plain sum of 991 of them divided by 991 is not 0.1.
  const Statistics s = statisticsOf(std::vector<double>(991, 0.1));
  EXPECT_EQ(s.mean, 0.1);
  EXPECT_EQ(s.sd, 0.0);
  EXPECT_EQ(s.ci_low, 0.1);
  EXPECT_EQ(s.ci_high, 0.1);
}

TEST(Statistics, AreTheSameEveryTime) {
  std::mt19937_64 generator(3);
  const std::vector<double> series = autoregressive(500, 0.8, generator);
  const Statistics first = statisticsOf(series);
  const Statistics second = statisticsOf(series);
  EXPECT_EQ(first.ci_low, second.ci_low);
  EXPECT_EQ(first.ci_high, second.ci_high);
}

TEST(ConfidenceInterval, OfIndependentValuesIsThatOfTheNormalLaw) {
  std::mt19937_64 generator(5);
  const Statistics s = statisticsOf(autoregressive(2000, 0.0, generator));
  const double expected = 1.96 * s.sd / std::sqrt(2000.0);
  // Of 2000 resamples the 2.5 % quantile is known to about 4 % of the half width (standard error of a
  // quantile), and blocks of more than one value add a few per cent.
  EXPECT_NEAR(s.ci_high - s.mean, expected, 0.15 * expected);
  EXPECT_NEAR(s.mean - s.ci_low, expected, 0.15 * expected);
}

TEST(ConfidenceInterval, HoldsTheMeanOfCorrelatedSeriesAboutAsOftenAsItSays) {
  // 95 % is the aim for long series. Block bootstraps are known to fall short by several per cent on
  // correlated series of this length (Politis and White 2004); the binomial error of 300 trials is 1.3 %.
  EXPECT_GT(shareOfIntervalsThatHoldTheMean(991, 0.0, 300), 0.91);
  EXPECT_GT(shareOfIntervalsThatHoldTheMean(991, 0.7, 300), 0.89);
  EXPECT_GT(shareOfIntervalsThatHoldTheMean(991, 0.9, 300), 0.86);
}

TEST(ConfidenceInterval, WithoutBlocksWouldHoldItFarTooSeldom) {
  // What the blocks are for: the interval for independent values, on the same correlated series.
  std::mt19937_64 generator(11);
  int held = 0;
  for (int i = 0; i < 300; ++i) {
    const Statistics s = statisticsOf(autoregressive(991, 0.9, generator));
    held += std::abs(s.mean) <= 1.96 * s.sd / std::sqrt(991.0) ? 1 : 0;
  }
  EXPECT_LT(held / 300.0, 0.5);
}

TEST(ConfidenceInterval, EndsAtTheValueOfMostToTheBit) {
  // Of 40 values a resample has none of the other two once in seven or eight times.
  for (const double most : {0.0, 0.1, 1.0}) {
    for (const std::size_t first_other : {0, 13}) {
      std::vector<double> above(40, most), below(40, most);
      for (const std::size_t i : {first_other, first_other + 20}) {
        above[i] += 0.3;
        below[i] -= 0.3;
      }
      EXPECT_EQ(statisticsOf(above).ci_low, most) << first_other;
      EXPECT_GT(statisticsOf(above).ci_high, most);
      EXPECT_EQ(statisticsOf(below).ci_high, most) << first_other;
      EXPECT_LT(statisticsOf(below).ci_low, most);
    }
  }
}

TEST(ConfidenceInterval, OfAShareIsNeverWithoutWidth) {
  // 0 of 10 by Wilson's formula: 1.96² / (10 + 1.96²) = 0.2775.
  // As nearly as a number can tell it, not by way of deviations from the first.
  std::vector<double> nine(20, 0.0);
  std::fill_n(nine.begin(), 9, 1.0);
  EXPECT_EQ(shareOf(nine).mean, 9.0 / 20.0);
  const Statistics none = shareOf(std::vector<double>(10, 0.0)), all = shareOf(std::vector<double>(10, 1.0));
  EXPECT_EQ(none.mean, 0.0);
  EXPECT_EQ(none.ci_low, 0.0);
  EXPECT_NEAR(none.ci_high, 0.2775, 5e-5);
  EXPECT_EQ(all.ci_high, 1.0);
  EXPECT_NEAR(all.ci_low, 1.0 - 0.2775, 5e-5);
  EXPECT_TRUE(std::isnan(shareOf({1.0}).ci_low));
  // Every other one of 12: any block of four has two, and each resample six. (0.5 + 1.96² / 24 ± 1.96 √(0.25
  // / 12 + 1.96² / 24²)) / (1 + 1.96² / 12).
  const Statistics other = shareOf({1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0});
  EXPECT_EQ(other.mean, 0.5);
  EXPECT_NEAR(other.ci_low, 0.2538, 5e-5);
  EXPECT_NEAR(other.ci_high, 0.7462, 5e-5);
  // The others are as they were.
  const std::vector<double> some = {1, 1, 0, 1, 1, 1, 0, 0, 1, 1, 1, 1};
  EXPECT_EQ(shareOf(some).ci_low, statisticsOf(some).ci_low);
  EXPECT_EQ(shareOf(some).ci_high, statisticsOf(some).ci_high);
}

TEST(BlockLength, GrowsWithCorrelation) {
  std::mt19937_64 generator(7);
  const std::size_t none = blockLength(autoregressive(2000, 0.0, generator));
  const std::size_t some = blockLength(autoregressive(2000, 0.5, generator));
  const std::size_t much = blockLength(autoregressive(2000, 0.95, generator));
  EXPECT_LE(none, 8u);  // 1 for the exact autocovariances; a few where chance correlates
  EXPECT_GT(some, none);
  EXPECT_GT(much, 2 * some);
}

TEST(BlockLength, IsNearThatOfTheExactAutocovariances) {
  // For an autoregressive series g(0) = σ²/(1−ρ)², G = 2ρσ²/((1−ρ)³(1+ρ))·…: the ratio G/g(0) is 2ρ/(1−ρ²),
  // which gives b = (2 (2ρ/(1−ρ²))² · 3/4 · n)^(1/3) = 24 for ρ = 0.7 and n = 1240. Estimates scatter by a
  // factor of about two.
  std::mt19937_64 generator(13);
  double sum = 0.0;
  for (int i = 0; i < 50; ++i) sum += static_cast<double>(blockLength(autoregressive(1240, 0.7, generator)));
  EXPECT_NEAR(sum / 50, 24.0, 8.0);
}

TEST(BlockLength, IsOneForConstantAndShortSeries) {
  EXPECT_EQ(blockLength({}), 1u);
  EXPECT_EQ(blockLength({1.0, 2.0, 3.0}), 1u);
  EXPECT_EQ(blockLength(std::vector<double>(100, 4.0)), 1u);
}

}  // namespace
}  // namespace sunlit::evaluate
