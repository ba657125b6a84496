#include "sunlit/evaluate/paired_test.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

#include "sunlit/evaluate/statistics.h"

namespace sunlit::evaluate {
namespace {

constexpr std::size_t kCountedBlocks = 16;  // 2¹⁵ ways and their mirror images
constexpr std::size_t kLeastBlocks = 6;     // of which p can be as low as 1/32
constexpr std::size_t kBits = 8;            // signs looked up at a time

// Without those that are 0, which no sign changes.
std::vector<double> sumsOfBlocks(const std::vector<double>& differences, std::size_t block_length) {
  std::vector<double> sums;
  for (std::size_t begin = 0; begin < differences.size(); begin += block_length) {
    const std::size_t end = std::min(begin + block_length, differences.size());
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) sum += differences[i];
    if (sum != 0.0) sums.push_back(sum);
  }
  return sums;
}

/// Sum of all blocks, of each turned or not, by bits.
class SignedSums {
 public:
  explicit SignedSums(const std::vector<double>& sums) : tables_((sums.size() + kBits - 1) / kBits) {
    for (std::size_t t = 0; t < tables_.size(); ++t) {
      for (std::size_t signs = 0; signs < tables_[t].size(); ++signs) {
        double sum = 0.0;
        for (std::size_t i = t * kBits; i < std::min((t + 1) * kBits, sums.size()); ++i)
          sum += (signs >> (i - t * kBits)) & 1U ? -sums[i] : sums[i];
        tables_[t][signs] = sum;
      }
    }
  }
  double of(std::uint64_t signs) const {
    double sum = 0.0;
    for (const auto& table : tables_) {
      sum += table[signs & 0xffU];
      signs >>= kBits;
    }
    return sum;
  }
  double drawn(std::mt19937_64& generator) const {
    constexpr std::size_t kTablesOfWord = 64 / kBits;
    double sum = 0.0;
    std::uint64_t signs = 0;
    for (std::size_t t = 0; t < tables_.size(); ++t) {
      signs = t % kTablesOfWord == 0 ? generator() : signs >> kBits;
      sum += tables_[t][signs & 0xffU];
    }
    return sum;
  }

 private:
  std::vector<std::array<double, 1U << kBits>> tables_;
};

/// From that of the bootstrap of `n` values.
std::size_t blockLengthOfSigns(std::size_t n, std::size_t block_length) {
  const std::size_t longest = std::max<std::size_t>(1, n / kLeastBlocks);
  return std::min(2 * block_length, longest);
}

}  // namespace

double signFlipP(const std::vector<double>& differences, std::size_t block_length) {
  const std::vector<double> sums = sumsOfBlocks(differences, block_length);
  if (sums.empty()) return 1.0;
  double all = 0.0;
  double size = 0.0;
  for (const double sum : sums) {
    all += sum;
    size += std::abs(sum);
  }
  const double as_far = std::abs(all) - 1e-12 * size;  // sums of equal numbers may be rounded differently
  const SignedSums signed_sums(sums);
  std::size_t count = 0;
  if (sums.size() <= kCountedBlocks) {  // the last block keeps its sign: the rest are mirror images
    const std::size_t ways = std::size_t{1} << (sums.size() - 1);
    for (std::size_t signs = 0; signs < ways; ++signs) count += std::abs(signed_sums.of(signs)) >= as_far;
    return static_cast<double>(count) / static_cast<double>(ways);
  }
  std::mt19937_64 generator(20240701);  // any fixed number, as for the intervals
  for (std::size_t i = 0; i < kSignFlips; ++i) count += std::abs(signed_sums.drawn(generator)) >= as_far;
  return static_cast<double>(1 + count) / static_cast<double>(1 + kSignFlips);
}

std::size_t signBlockLength(const std::vector<double>& differences) {
  return blockLengthOfSigns(differences.size(), blockLength(differences));
}

PairedTest pairedTest(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) throw std::invalid_argument("a paired test needs as many values of a as of b");
  PairedTest test;
  std::vector<double> differences;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i]) || std::isnan(b[i])) {
      ++test.undefined;
    } else if (std::isinf(a[i]) || std::isinf(b[i])) {
      ++test.failed;
    } else {
      differences.push_back(a[i] - b[i]);
    }
  }
  const Statistics statistics = statisticsOf(differences);
  test.n = statistics.n;
  test.mean_difference = statistics.mean;
  test.low = statistics.ci_low;
  test.high = statistics.ci_high;
  test.p = kNaN;
  if (test.n < 2) return test;
  test.block_length = blockLengthOfSigns(test.n, statistics.block_length);
  test.p = signFlipP(differences, test.block_length);
  return test;
}

std::vector<double> holm(const std::vector<double>& p) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!std::isnan(p[i])) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t l, std::size_t r) { return p[l] < p[r]; });
  std::vector<double> adjusted(p.size(), kNaN);
  double largest = 0.0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    largest = std::max(largest, static_cast<double>(order.size() - k) * p[order[k]]);
    adjusted[order[k]] = std::min(largest, 1.0);
  }
  return adjusted;
}

}  // namespace sunlit::evaluate
