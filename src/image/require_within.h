/// How this module refuses a number.
#pragma once

namespace sunlit::image {

/// Throws std::invalid_argument "key: value is outside low … high"; NaN is refused too.
void requireWithin(const char* key, double value, double low, double high);

}  // namespace sunlit::image
