/// Random numbers by place in a sequence, so that any thread can draw any of them.
#pragma once

#include <cmath>
#include <cstdint>

namespace sunlit::image {

/// The mixing function of SplitMix64 (Steele, Lea and Flood 2014, with the constants of Vigna's
/// implementation): every bit of the input changes each of the output with probability one half.
inline std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31);
}

/// SplitMix64 whose n-th number is had without those before it. Whole-number arithmetic, +, ·, √ and nothing
/// of the C library that computers could disagree on.
class RandomSequence {
 public:
  explicit RandomSequence(std::uint64_t start, std::uint64_t place) : state_(start + place * kStep) {}

  std::uint64_t next() { return mixed(state_ += kStep); }
  /// In [0, 1), in steps of 2⁻⁵³.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

  /// Mean 0, variance 1: 128 tosses of a coin, whose sum has variance 32, blurred by a triangle of one
  /// toss's width (variance 1/6) so that the steps do not show. The tails are thinner than a normal
  /// distribution's by a kurtosis of −0.016.
  double normal() {
    const int heads = bitsSet(next()) + bitsSet(next());
    const std::uint64_t blur = next();
    const double triangle =
        static_cast<double>(blur >> 32) * 0x1p-32 - static_cast<double>(blur & 0xFFFFFFFFULL) * 0x1p-32;
    static const double scale = 1.0 / std::sqrt(32.0 + 1.0 / 6.0);
    return (heads - 64 + triangle) * scale;
  }

  /// A Poisson number of this mean, ≥ 0; from 24 on a normal number of the same mean and variance.
  double poisson(double mean) {
    if (mean >= kNormalFrom) return mean + std::sqrt(mean) * normal();
    // By inversion: goes through the numbers until their probabilities add up to more than a uniform number.
    const double u = uniform();
    double probability = expOfMinus(mean);
    double sum = probability;
    int number = 0;
    while (u >= sum && number < kLargest) {
      ++number;
      probability *= mean / number;
      sum += probability;
    }
    return number;
  }

 private:
  static constexpr std::uint64_t kStep = 0x9E3779B97F4A7C15ULL;  // the golden ratio, odd
  static constexpr double kNormalFrom = 24.0;
  static constexpr int kLargest = 100;  // of a mean of 24: beyond 15 standard deviations

  static int bitsSet(std::uint64_t x) {
    x -= (x >> 1) & 0x5555555555555555ULL;
    x = (x & 0x3333333333333333ULL) + ((x >> 2) & 0x3333333333333333ULL);
    x = (x + (x >> 4)) & 0x0F0F0F0F0F0F0F0FULL;
    return static_cast<int>((x * 0x0101010101010101ULL) >> 56);
  }

  /// e^−x for x in [0, 24), within 1e-12: the series at x/64, squared six times.
  static double expOfMinus(double x) {
    const double y = x * -0x1p-6;
    double sum = 1.0;
    for (int n = 10; n > 0; --n) sum = 1.0 + y / n * sum;
    for (int i = 0; i < 6; ++i) sum *= sum;
    return sum;
  }

  std::uint64_t state_;
};

}  // namespace sunlit::image
