/// The sRGB curve of 8-bit pictures.
#pragma once

#include <array>

namespace sunlit::image {

/// Linear value, 0 … 1, of each 8-bit code of an sRGB channel: IEC 61966-2-1 in double, rounded once.
const std::array<float, 256>& linearOfSrgb();

}  // namespace sunlit::image
