/// Textures whose texels are squares.
#pragma once

#include "sunlit/image/texture_files.h"

namespace sunlit::scene {

/// px. Of a larger texture the texels stay as they are.
constexpr int kLongestOfSquares = 1024;

/// `picture` with each of its pixels as a square of up to 16 × 16, and a longest side of at most twice
/// kLongestOfSquares: as colours are blended from pixel to pixel where a texture is seen from near, they then
/// are at the borders of squares alone.
image::Rgba8Image withSquares(const image::Rgba8Image& picture);

}  // namespace sunlit::scene
