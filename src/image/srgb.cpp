#include "sunlit/image/srgb.h"

#include <cmath>
#include <cstddef>

namespace sunlit::image {

const std::array<float, 256>& linearOfSrgb() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double encoded = static_cast<double>(i) / 255.0;
      values[i] =
          static_cast<float>(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
    }
    return values;
  }();
  return table;
}

}  // namespace sunlit::image
