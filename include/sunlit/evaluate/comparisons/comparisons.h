/// comparisons.csv: which differences between methods, and between hours, are more than chance.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sunlit/evaluate/comparisons/measured.h"
#include "sunlit/evaluate/paired_test.h"
#include "sunlit/evaluate/stop_token.h"

namespace sunlit::evaluate {

/// Two drives are at one place where they are no further apart: as places that are recognised, by default.
constexpr double kSharedPlace_m = 5.0;

/// What is compared along the same poses: `a` less `b`. Series of two drives (Measured::drive) have the same
/// pose where their places are nearest to each other, both ways, of those within kSharedPlace_m that look the
/// same way, within kSameWay_deg.
struct Comparison {
  std::string metric;
  std::string family;  ///< "methods" between the same hours, or "hours" of the same method
  std::string same;    ///< the hours or the method that both have
  std::string a;
  std::string b;
  PairedTest test;
  std::size_t unpaired = 0;  ///< poses that only one of them has
  double p_holm = 0.0;       ///< holm() of all that have the same metric and family
};

struct Comparisons {
  std::vector<Comparison> rows;       ///< by metric, then family, in the order of what is measured
  std::vector<std::string> left_out;  ///< of families of more than kMostCompared what, and why, in words
  /// Of each two series' hours that are of two drives how many poses they share, in words.
  std::vector<std::string> paired_by_place;
};

/// Of more in one family the least p, 1 / (1 + kSignFlips), could not become 0.05.
constexpr std::size_t kMostCompared = 5000;

/// Every two methods between the same hours, and every two hours of a method that share one of
/// Measured::streams; where these are more than kMostCompared in a family, those that share one of
/// `references`, as the map.
/// In parallel; the result does not depend on the number of threads. Throws Stopped.
Comparisons comparisonsOf(const std::vector<Measured>& measured, const std::vector<std::string>& references,
                          const StopToken& stop = {});

/// Columns `metric,family,same,a,b,n,undefined,failed,unpaired,mean_difference,low,high,p,p_holm,
/// block_length`; numbers with 17 digits, `nan` where there is none. In one step. Throws std::runtime_error.
void writeComparisons(const std::string& path, const std::vector<Comparison>& rows);

}  // namespace sunlit::evaluate
