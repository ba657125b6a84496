/// Mean, spread and confidence of one difference over a path: equations (1) and (2) of the paper.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace sunlit::evaluate {

/// What is undefined, as the mean of no values.
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Statistics of a series. Undefined (NaN) values are counted and kept out of everything else.
///
/// Merging: statistics of a whole are computed from the raw values of its parts, ordered by pose, so that a
/// path cut into shards gives the same bits as the path at once.
struct Statistics {
  std::size_t n = 0;          ///< defined values
  std::size_t undefined = 0;  ///< NaN values
  double mean = 0.0;          ///< E, (1); NaN where n is 0
  double sd = 0.0;            ///< s, (2), divided by n − 1; NaN where n < 2
  double ci_low = 0.0;        ///< 95 % confidence interval of the mean; NaN where n < 2
  double ci_high = 0.0;
  std::size_t block_length = 0;  ///< of the bootstrap that gives it; 0 where n < 2
};

/// `values` in the order of the path. Neighbouring frames see nearly the same place, so the interval is that
/// of a circular moving-block bootstrap (blockLength(), 2000 resamples, percentiles, a fixed seed): same
/// values, same interval.
Statistics statisticsOf(const std::vector<double>& values);
/// Of successes, 1 or 0 each: the same, but where all resamples have one mean, which they take for certain,
/// Wilson's interval (E. B. Wilson, J. Am. Stat. Assoc. 22 (1927), 209-212) of n trials: where all or none
/// succeed, and where successes alternate so that each block has as many, as on poses of which every other is
/// that of a key frame.
Statistics shareOf(const std::vector<double>& successes);
/// As statisticsOf(), but for the interval: it is NaN.
Statistics momentsOf(const std::vector<double>& values);

/// Length of the blocks that keep the correlation of neighbours: the automatic rule of Politis and White
/// (2004) with the correction of Patton, Politis and White (2009) for the circular bootstrap, at least 1 and
/// at most a third of the series.
std::size_t blockLength(const std::vector<double>& series);

}  // namespace sunlit::evaluate
