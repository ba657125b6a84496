#include "sunlit/evaluate/differences/difference.h"

namespace sunlit::evaluate {

DifferenceValue sameBothWays(double value) {
  DifferenceValue result;
  result.value = result.symmetric = result.one_to_one = value;
  return result;
}

}  // namespace sunlit::evaluate
