/// Pictures with an alpha channel from files: what textures are made of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "sunlit/image/images.h"

namespace sunlit::image {

using Rgba8Image = Picture<std::uint8_t, 4>;  ///< colour sRGB-encoded, alpha linear, not premultiplied

/// Decodes a PNG, JPEG, BMP, TIFF, TGA or WebP picture held in memory, by its content. Grey becomes three
/// equal channels, with an alpha of 0 where it is the level that a PNG cuts out; 16 bit is rounded to 8, a
/// missing alpha is 255. Throws std::runtime_error naming `name` if the bytes cannot be decoded, or are
/// floats, which are no values of a display.
Rgba8Image decodeRgba(const std::uint8_t* bytes, std::size_t size, const std::string& name);

/// A picture, and the size, px, that it has in its file.
struct FittedImage {
  Rgba8Image picture;
  int width = 0;
  int height = 0;
};

/// px. OpenCV decodes a PNG as a whole, with up to 8 bytes a pixel.
constexpr std::int64_t kMostPixels = std::int64_t{1} << 29;

/// As decodeRgba(), but a picture with a side of more than `longest_px` comes as the mean of its pixels with
/// a longest side of `longest_px`. Also throws for one of more than kMostPixels, as far as its first bytes
/// tell (PNG, JPEG, BMP and TGA; others OpenCV refuses beyond 2^30). One large picture is decoded at a time,
/// for the memory that it takes.
FittedImage decodeRgbaWithin(int longest_px, const std::uint8_t* bytes, std::size_t size,
                             const std::string& name);
/// The same from a file. Throws std::runtime_error with its path also if it cannot be read.
FittedImage readRgbaWithin(int longest_px, const std::string& file);

/// `picture` with the opacity of another, that one's alpha if it has any below 255, else the mean of its red,
/// green and blue; as wide as the wider and as high as the higher of them.
Rgba8Image coveredBy(const Rgba8Image& picture, const Rgba8Image& opacity);

/// One value a pixel.
struct GreyPicture {
  Picture<float, 1> values;
  std::size_t filled = 0;  ///< how many pixels of the file tell no value
};
/// Such as heights: 8 and 16 bit as shares of their full range, floats as they are; of colours the mean of
/// red, green and blue. Pixels for which a file tells that nothing was measured, by its tag 42113, −9999,
/// −32768, −32767, ±3.4e38 or more, or as no number, get the lowest value of the others. Throws
/// std::runtime_error as readRgbaWithin() does.
GreyPicture readGreyWithin(int longest_px, const std::string& file);

/// A PNG file in memory, lossless. Throws std::runtime_error if the picture is empty.
std::string encodePng(const Rgba8Image& picture);

}  // namespace sunlit::image
