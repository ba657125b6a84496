/// Which values of two series are compared.
#pragma once

#include <cstddef>
#include <vector>

#include "sunlit/evaluate/comparisons/measured.h"

namespace sunlit::evaluate {

/// Values of both at the same poses, in the order of the first's.
struct Paired {
  std::vector<double> a;
  std::vector<double> b;
  std::size_t unpaired = 0;  ///< values that are in neither
};

/// Of one drive by the numbers of poses; of two by places, which are those nearest to each other, both ways,
/// of those at most kSharedPlace_m apart that look the same way (kSameWay_deg), of equally near ones the
/// first.
Paired pairedOf(const Measured& first, const Measured& second);

}  // namespace sunlit::evaluate
