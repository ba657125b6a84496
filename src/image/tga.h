/// Truevision TGA pictures (Truevision TGA File Format Specification 2.0), which OpenCV does not read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sunlit::image {

/// px.
struct TgaSize {
  int width = 0, height = 0;
};

/// Its size, if the bytes begin as those of a TGA picture that has any: the format has no signature, but no
/// other that is read begins as its header must.
std::optional<TgaSize> sizeOfTga(const std::uint8_t* bytes, std::size_t size);

/// Decodes one for which sizeOfTga() tells a size, grey, true-colour or indexed, plain or run-length encoded:
/// blue, green, red and alpha of each pixel, row by row from the top; without an alpha that is 255. Throws
/// std::runtime_error that begins with `name` where it is cut off, or has pixels of colours that it has not.
std::vector<std::uint8_t> decodeTga(const std::uint8_t* bytes, std::size_t size, const std::string& name);

}  // namespace sunlit::image
