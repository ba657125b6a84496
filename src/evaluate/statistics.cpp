#include "sunlit/evaluate/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>
#include <random>

namespace sunlit::evaluate {
namespace {

constexpr std::size_t kResamples = 2000;
constexpr double kTail = 0.025;                        // on either side of a 95 % interval
constexpr double kNormalQuantile = 1.959963984540054;  // of 1 - kTail

std::vector<double> definedOf(const std::vector<double>& values) {
  std::vector<double> series;
  series.reserve(values.size());
  std::copy_if(values.begin(), values.end(), std::back_inserter(series),
               [](double value) { return !std::isnan(value); });
  return series;
}

// By way of deviations from the first value, so that the mean of equal values is that value to the bit.
double meanOf(const std::vector<double>& series) {
  double sum = 0.0;
  for (const double value : series) sum += value - series.front();
  return series.front() + sum / static_cast<double>(series.size());
}

// Autocovariances of lags 0 … max_lag, divided by n as Politis and White do.
std::vector<double> autocovariances(const std::vector<double>& series, std::size_t max_lag) {
  const double mean = meanOf(series);
  std::vector<double> result(max_lag + 1, 0.0);
  for (std::size_t lag = 0; lag <= max_lag; ++lag) {
    for (std::size_t i = lag; i < series.size(); ++i)
      result[lag] += (series[i] - mean) * (series[i - lag] - mean);
    result[lag] /= static_cast<double>(series.size());
  }
  return result;
}

// The smallest lag after which `run` autocorrelations in a row are insignificant (Politis and White,
// section 3.2).
std::size_t significantLags(const std::vector<double>& covariances, std::size_t run, double bound) {
  std::size_t last_significant = 0;
  std::size_t insignificant = 0;
  for (std::size_t lag = 1; lag < covariances.size(); ++lag) {
    if (std::abs(covariances[lag] / covariances[0]) < bound) {
      if (++insignificant == run) return lag - run;
    } else {
      insignificant = 0;
      last_significant = lag;
    }
  }
  return last_significant;
}

// Uniform in [0, n). std::uniform_int_distribution differs between standard libraries; the bias of this, n /
// 2⁶⁴, is nil.
std::size_t uniformBelow(std::mt19937_64& generator, std::size_t n) {
  return generator() % n;
}

// One of the values, of which as many lie below as above.
double middleOf(std::vector<double> series) {
  const auto middle = series.begin() + static_cast<std::ptrdiff_t>(series.size() / 2);
  std::nth_element(series.begin(), middle, series.end());
  return *middle;
}

// Means of resamples made of blocks of a series bent into a circle, so that every value is drawn equally
// often. By way of deviations from the value in the middle: a resample often enough of one value alone to
// set a limit is of that of the most, and its mean is this value to the bit.
std::vector<double> resampledMeans(const std::vector<double>& series, std::size_t block) {
  const std::size_t n = series.size();
  const double middle = middleOf(series);
  std::vector<double> cumulative(2 * n + 1, 0.0);
  for (std::size_t i = 0; i < 2 * n; ++i) cumulative[i + 1] = cumulative[i] + (series[i % n] - middle);
  std::mt19937_64 generator(20240701);  // any fixed number; this is the paper's date
  std::vector<double> means(kResamples);
  for (double& resampled : means) {
    double sum = 0.0;
    for (std::size_t taken = 0; taken < n; taken += block) {
      const std::size_t start = uniformBelow(generator, n);
      const std::size_t length = std::min(block, n - taken);
      sum += cumulative[start + length] - cumulative[start];
    }
    resampled = middle + sum / static_cast<double>(n);
  }
  return means;
}

// Linear between order statistics.
double quantile(const std::vector<double>& sorted, double share) {
  const double position = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

std::size_t blockLength(const std::vector<double>& series) {
  const std::size_t n = series.size();
  if (n < 4) return 1;
  const double size = static_cast<double>(n);
  const auto run = static_cast<std::size_t>(std::max(5.0, std::ceil(std::sqrt(std::log10(size)))));
  const std::size_t max_lag = std::min(n - 1, static_cast<std::size_t>(std::ceil(std::sqrt(size))) + run);
  const std::vector<double> covariances = autocovariances(series, max_lag);
  if (!(covariances[0] > 0.0)) return 1;
  const std::size_t lags = significantLags(covariances, run, 2.0 * std::sqrt(std::log10(size) / size));
  const std::size_t window = std::min(2 * std::max<std::size_t>(lags, 1), max_lag);
  double spectrum = covariances[0];  // g(0)
  double slope = 0.0;                // G
  for (std::size_t lag = 1; lag <= window; ++lag) {
    const double share = static_cast<double>(lag) / static_cast<double>(window);
    const double weight = share <= 0.5 ? 1.0 : 2.0 * (1.0 - share);  // flat-top window
    spectrum += 2.0 * weight * covariances[lag];
    slope += 2.0 * weight * static_cast<double>(lag) * covariances[lag];
  }
  const double variance = 4.0 / 3.0 * spectrum * spectrum;  // D of the circular bootstrap
  const double longest = std::max(1.0, std::min(std::ceil(3.0 * std::sqrt(size)), size / 3.0));
  if (!(variance > 0.0)) return static_cast<std::size_t>(longest);
  const double length = std::ceil(std::cbrt(2.0 * slope * slope / variance * size));
  return static_cast<std::size_t>(std::clamp(length, 1.0, longest));
}

Statistics momentsOf(const std::vector<double>& values) {
  const std::vector<double> series = definedOf(values);
  Statistics result;
  result.n = series.size();
  result.undefined = values.size() - series.size();
  result.mean = result.sd = result.ci_low = result.ci_high = kNaN;
  if (result.n == 0) return result;
  result.mean = meanOf(series);
  if (result.n < 2) return result;
  double squares = 0.0;
  for (const double value : series) squares += (value - result.mean) * (value - result.mean);
  result.sd = std::sqrt(squares / static_cast<double>(result.n - 1));
  return result;
}

Statistics statisticsOf(const std::vector<double>& values) {
  Statistics result = momentsOf(values);
  if (result.n < 2) return result;
  if (result.sd == 0.0) {  // so would all resampled means be, to the bit
    result.ci_low = result.ci_high = result.mean;
    result.block_length = 1;
    return result;
  }
  const std::vector<double> series = definedOf(values);
  result.block_length = blockLength(series);
  std::vector<double> means = resampledMeans(series, result.block_length);
  std::sort(means.begin(), means.end());
  result.ci_low = quantile(means, kTail);
  result.ci_high = quantile(means, 1.0 - kTail);
  return result;
}

namespace {

// That of the share in `result`. Where all or none succeed one of its ends is the share itself, to the bit.
void takeWilsonsInterval(Statistics& result) {
  const double n = static_cast<double>(result.n), share = result.mean;
  const double square = kNormalQuantile * kNormalQuantile;
  const double middle = (n * share + square / 2.0) / (n + square);
  const double reach = kNormalQuantile * std::sqrt(n * share * (1.0 - share) + square / 4.0) / (n + square);
  result.ci_low = share == 0.0 ? 0.0 : middle - reach;
  result.ci_high = share == 1.0 ? 1.0 : middle + reach;
}

}  // namespace

Statistics shareOf(const std::vector<double>& successes) {
  Statistics result = statisticsOf(successes);
  const std::vector<double> series = definedOf(successes);
  // Of ones and zeros the sum is exact, and so is what is nearest to the fraction.
  if (!series.empty())
    result.mean = std::accumulate(series.begin(), series.end(), 0.0) / static_cast<double>(series.size());
  if (result.n >= 2 && !(result.ci_low < result.ci_high)) takeWilsonsInterval(result);
  return result;
}

}  // namespace sunlit::evaluate
