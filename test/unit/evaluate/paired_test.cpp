#include "sunlit/evaluate/paired_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "sunlit/evaluate/statistics.h"

namespace sunlit::evaluate {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Crossed less self-fertilised maize, in eighths of an inch: Darwin's pairs.
const std::vector<double> kMaize = {49, -67, 8, 16, 6, 23, 28, 41, 14, 29, 56, 24, 75, 60, -48};

std::vector<double> repeated(double value, std::size_t times, std::vector<double> behind = {}) {
  behind.insert(behind.begin(), times, value);
  return behind;
}

TEST(SignFlip, GivesFishersCountForDarwinsMaize) {
  // R. A. Fisher, The Design of Experiments (1935), section 21: 863 of the 32,768 ways have as large a sum,
  // 1,726 in either direction.
  EXPECT_EQ(signFlipP(kMaize, 1), 1726.0 / 32768.0);
}

TEST(SignFlip, IsMcNemarsTestOfHitsAndMisses) {
  // Of 13 poses where only one of two succeeds, 3 are the other's: scipy.stats.binomtest(3, 13).pvalue.
  const std::vector<double> differences = repeated(0.0, 100, repeated(1.0, 10, repeated(-1.0, 3)));
  EXPECT_EQ(signFlipP(differences, 1), 0.09228515625);
}

TEST(SignFlip, DrawsWhereThereAreTooManyToCount) {
  // scipy.stats.binomtest(5, 20).pvalue; four standard errors of 99,999 drawings.
  EXPECT_NEAR(signFlipP(repeated(1.0, 15, repeated(-1.0, 5)), 1), 0.04138946533, 4 * 6.3e-4);
  // 100 ones: 2⁻⁹⁹, so that none is drawn.
  EXPECT_EQ(signFlipP(std::vector<double>(100, 1.0), 1), 1.0 / (1.0 + kSignFlips));
  // 65 and more need a second word of signs: scipy.stats.binomtest(60, 140).pvalue.
  EXPECT_NEAR(signFlipP(repeated(1.0, 80, repeated(-1.0, 60)), 1), 0.1079876300, 4 * 9.8e-4);
}

TEST(SignFlip, TurnsWholeBlocks) {
  const std::vector<double> differences = {1, 1, -2, -2, 3, 3};
  // Sums 2, −4, 6 make 4; of 12, 4, 8 and 0 three are as far.
  EXPECT_EQ(signFlipP(differences, 2), 0.75);
  EXPECT_EQ(signFlipP(differences, 4), 1.0);  // −2 and a short block of 6: 4 or 8
  EXPECT_EQ(signFlipP(differences, 6), 1.0);  // one block says nothing
}

TEST(SignFlip, FindsNothingInNothing) {
  EXPECT_EQ(signFlipP({0, 0, 0}, 1), 1.0);
  EXPECT_EQ(signFlipP({1, -1, 1, -1}, 2), 1.0);
}

// x_t = 0.7 x_{t−1} + noise, about a mean.
std::vector<double> correlated(std::size_t n, double mean, std::mt19937_64& generator) {
  std::normal_distribution<double> noise;
  std::vector<double> series(n);
  double x = noise(generator) / std::sqrt(1.0 - 0.7 * 0.7);
  for (double& value : series) {
    value = mean + x;
    x = 0.7 * x + noise(generator);
  }
  return series;
}

/// Of 400 series of 300 values: how many have p < 0.05 by blocks of length(series).
template <typename Length>
double shareFound(double mean, const Length& length) {
  std::mt19937_64 generator(23);
  int found = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const std::vector<double> series = correlated(300, mean, generator);
    found += signFlipP(series, length(series)) < 0.05;
  }
  return found / 400.0;
}

TEST(SignFlip, FindsWhatIsNotThereAsSeldomAsItSaysInCorrelatedSeries) {
  // 5 % is the aim; 5.2 % in 1,000 such series by NumPy. The binomial error of 400 is 1.1 %.
  EXPECT_LT(shareFound(0.0, signBlockLength), 0.052 + 3 * 0.011);
  EXPECT_GT(shareFound(0.0, signBlockLength), 0.052 - 3 * 0.011);
  // What the blocks are for: value by value, chance passes for a difference in two of five series.
  EXPECT_GT(shareFound(0.0, [](const auto&) { return std::size_t{1}; }), 0.25);
}

TEST(SignFlip, FindsWhatIsThere) {
  // The mean of such a series has the standard error 1 / (1 − 0.7) / √300 = 0.19; five of them.
  EXPECT_GT(shareFound(0.96, signBlockLength), 0.95);
}

TEST(SignFlip, HasAtLeastSixBlocks) {
  for (const std::size_t n : {6U, 12U, 60U}) {
    std::vector<double> rising(n);
    for (std::size_t i = 0; i < n; ++i) rising[i] = static_cast<double>(i);
    EXPECT_LE(signBlockLength(rising), n / 6) << n;
  }
  EXPECT_EQ(signBlockLength({1, 2, 3}), 1u);
}

TEST(PairedTest, CountsWhatCannotBeCompared) {
  const PairedTest test = pairedTest({1, kNaN, 3, kInfinity, 5, kInfinity}, {0, 1, 1, 1, kInfinity, kNaN});
  EXPECT_EQ(test.n, 2u);
  EXPECT_EQ(test.undefined, 2u);
  EXPECT_EQ(test.failed, 2u);
  EXPECT_EQ(test.mean_difference, 1.5);
  EXPECT_EQ(test.block_length, 1u);
  EXPECT_EQ(test.p, 0.5);  // 3 and 1
}

TEST(PairedTest, HasTheIntervalOfTheDifferences) {
  std::mt19937_64 generator(1);
  std::normal_distribution<double> noise;
  std::vector<double> a(300), b(300), differences(300);
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] = noise(generator);
    b[i] = noise(generator);
    differences[i] = a[i] - b[i];
  }
  const PairedTest test = pairedTest(a, b);
  const Statistics statistics = statisticsOf(differences);
  EXPECT_EQ(test.mean_difference, statistics.mean);
  EXPECT_EQ(test.low, statistics.ci_low);
  EXPECT_EQ(test.high, statistics.ci_high);
  EXPECT_EQ(pairedTest(b, a).p, test.p) << "two-sided";
}

TEST(PairedTest, TellsNothingOfNothing) {
  const PairedTest none = pairedTest({}, {});
  EXPECT_TRUE(std::isnan(none.mean_difference) && std::isnan(none.low) && std::isnan(none.p));
  const PairedTest one = pairedTest({2}, {1});
  EXPECT_EQ(one.mean_difference, 1.0);
  EXPECT_TRUE(std::isnan(one.high) && std::isnan(one.p));
  EXPECT_THROW(pairedTest({1}, {}), std::invalid_argument);
}

TEST(Holm, IsAsWorkedOutByHand) {
  // 4 · 0.005, 3 · 0.01 and 2 · 0.03; 0.04 is not below the one before it.
  const std::vector<double> adjusted = holm({0.01, 0.04, kNaN, 0.03, 0.005});
  EXPECT_DOUBLE_EQ(adjusted[0], 0.03);
  EXPECT_DOUBLE_EQ(adjusted[1], 0.06);
  EXPECT_TRUE(std::isnan(adjusted[2]));
  EXPECT_DOUBLE_EQ(adjusted[3], 0.06);
  EXPECT_DOUBLE_EQ(adjusted[4], 0.02);
  EXPECT_EQ(holm({0.6, 0.7})[1], 1.0);
}

}  // namespace
}  // namespace sunlit::evaluate
