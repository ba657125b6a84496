#include "sunlit/evaluate/matching.h"

#include <cmath>
#include <limits>

namespace sunlit::evaluate {

bool passes(const Neighbours& neighbours, const RatioTest& test) {
  const double best = neighbours.best_distance;
  const double bound = test.ratio * neighbours.second_distance;
  return test.inclusive ? best <= bound : best < bound;
}

DifferenceValue featureDifference(const Features& a, const Features& b, int norm, const RatioTest& test) {
  DifferenceValue result;
  result.features_a = static_cast<std::uint32_t>(a.descriptors.rows);
  result.features_b = static_cast<std::uint32_t>(b.descriptors.rows);
  for (const Neighbours& neighbours : twoNearest(a.descriptors, b.descriptors, norm)) {
    if (neighbours.second_distance == 0.0F) ++result.zero_second;
    if (passes(neighbours, test)) ++result.matches;
  }
  const double matched = result.matches;
  const double total = static_cast<double>(result.features_a) + result.features_b - matched;
  result.value = total > 0.0 ? (total - matched) / total : std::numeric_limits<double>::quiet_NaN();
  return result;
}

}  // namespace sunlit::evaluate
