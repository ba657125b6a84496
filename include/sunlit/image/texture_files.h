/// Pictures with an alpha channel from files: what textures are made of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "sunlit/image/images.h"

namespace sunlit::image {

using Rgba8Image = Picture<std::uint8_t, 4>;  ///< colour sRGB-encoded, alpha linear, not premultiplied

/// Decodes a PNG, JPEG, BMP, TIFF, or WebP picture held in memory. Grey becomes three equal channels, 16 bit
/// is rounded to 8, a missing alpha is 255. Throws std::runtime_error naming `name` if the bytes cannot be
/// decoded.
Rgba8Image decodeRgba(const std::uint8_t* bytes, std::size_t size, const std::string& name);

/// The same from a file. Throws std::runtime_error with its path if it cannot be read or decoded.
Rgba8Image readRgba(const std::string& file);

/// A PNG file in memory, lossless. Throws std::runtime_error if the picture is empty.
std::string encodePng(const Rgba8Image& picture);

}  // namespace sunlit::image
