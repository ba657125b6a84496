/// Refusing values out of range.
#pragma once

namespace sunlit::sky {

/// Throws std::invalid_argument naming key, value and range unless low ≤ value ≤ high.
void requireWithin(const char* key, double value, double low, double high);

}  // namespace sunlit::sky
