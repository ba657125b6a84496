/// Allowed ranges of the evaluation's options.
#pragma once

#include "sunlit/evaluate/comparer.h"

namespace sunlit::evaluate {

/// Throws std::invalid_argument naming key, value and range of the first option out of range.
void checkLimits(const ComparerOptions& options);

}  // namespace sunlit::evaluate
