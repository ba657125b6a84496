/// The size of a compressed picture by its first bytes, so that nothing is decoded that is too large.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace sunlit::image {

/// What a PNG or JPEG says of itself before its pixels.
struct EncodedPicture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  bool is_lossy = false;      ///< JPEG
  bool is_grey = false;       ///< of one channel, besides alpha
  bool is_cut_short = false;  ///< without its end; decoders fill up what is missing, and say nothing
};

/// Nothing where `bytes` are neither, or end before the size is told.
std::optional<EncodedPicture> encodedPicture(const std::uint8_t* bytes, std::size_t size);

}  // namespace sunlit::image
