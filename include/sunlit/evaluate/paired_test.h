/// Whether two things measured at the same poses differ by more than chance.
#pragma once

#include <cstddef>
#include <vector>

namespace sunlit::evaluate {

/// a − b over the poses of a path. Where there is nothing to tell, numbers are NaN.
struct PairedTest {
  std::size_t n = 0;             ///< poses where both are defined and finite; what follows is of them
  std::size_t undefined = 0;     ///< poses where one of them is NaN
  std::size_t failed = 0;        ///< other poses where one of them is infinite, as the error of what is lost
  double mean_difference = 0.0;  ///< NaN where n is 0
  double low = 0.0;              ///< 95 % interval of the mean, by statisticsOf(); NaN where n < 2
  double high = 0.0;
  double p = 0.0;                ///< signFlipP(); NaN where n < 2
  std::size_t block_length = 0;  ///< of p, signBlockLength() of the differences; 0 where n < 2
};

/// `a` and `b` by rising pose, of equal size (std::invalid_argument otherwise).
PairedTest pairedTest(const std::vector<double>& a, const std::vector<double>& b);

/// How likely a mean as far from 0 is, or farther, where a and b might as well change places. Neighbours
/// change together: the differences are cut into blocks of `block_length` (≥ 1), the last one being shorter,
/// and of each block all signs are kept or turned (I. A. Canay, J. P. Romano, A. M. Shaikh, Econometrica 85
/// (2017), 1013-1030, eq. 2-5). Two-sided. All ways are counted where at most 16 blocks have a sum other than
/// 0, else kSignFlips drawn ones with a fixed seed, p = (1 + as far) / (1 + kSignFlips). Of 0 and ±1 in
/// blocks of one it is McNemar's exact test. 1 where all sums are 0.
double signFlipP(const std::vector<double>& differences, std::size_t block_length);
constexpr std::size_t kSignFlips = 99999;

/// Twice blockLength(), that blocks of which each must stand for itself be less alike, but at least six
/// blocks where there are six values.
std::size_t signBlockLength(const std::vector<double>& differences);

/// Adjusted for all being looked at together: p rising, the k-th of m becomes max(m − k + 1) p up to it, at
/// most 1 (S. Holm, Scand. J. Statist. 6 (1979), 65-70). NaN stays, and does not count.
std::vector<double> holm(const std::vector<double>& p);

}  // namespace sunlit::evaluate
