#include "sunlit/evaluate/features/matching.h"

namespace sunlit::evaluate {

bool passes(const Neighbours& neighbours, const RatioTest& test) {
  const double best = neighbours.best_distance;
  const double bound = test.ratio * neighbours.second_distance;
  return test.inclusive ? best <= bound : best < bound;
}

}  // namespace sunlit::evaluate
