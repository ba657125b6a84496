/// What libjpeg says of a JPEG's data.
#pragma once

#include <cstddef>
#include <cstdint>

namespace sunlit::image {

/// As isDamagedJpeg() of codecs.h.
bool damagedJpeg(const std::uint8_t* bytes, std::size_t size);

}  // namespace sunlit::image
