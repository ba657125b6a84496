/// The parts of a PNG file (ISO/IEC 15948, 5).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace sunlit::image {

constexpr std::array<std::uint8_t, 8> kPngSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

inline bool isPng(const std::uint8_t* bytes, std::size_t size) {
  return size >= kPngSignature.size() && std::equal(kPngSignature.begin(), kPngSignature.end(), bytes);
}

struct PngChunk {
  std::string_view name;
  std::size_t end;  ///< where the next one begins
};

/// That which begins at `at`, the first behind the signature; nothing where `bytes` end within it.
inline std::optional<PngChunk> pngChunkAt(std::size_t at, const std::uint8_t* bytes, std::size_t size) {
  constexpr std::size_t kAroundData = 12;  // length, name and checksum
  if (size < kAroundData || at > size - kAroundData) return std::nullopt;
  const std::size_t data = std::size_t{bytes[at]} << 24 | std::size_t{bytes[at + 1]} << 16 |
                           std::size_t{bytes[at + 2]} << 8 | std::size_t{bytes[at + 3]};
  if (data > size - kAroundData - at) return std::nullopt;
  return PngChunk{{reinterpret_cast<const char*>(bytes) + at + 4, 4}, at + kAroundData + data};
}

}  // namespace sunlit::image
