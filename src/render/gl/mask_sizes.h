/// Which sizes of its mask a triangle shows, before any of its samples is looked at.
#pragma once

#include "render/screen_triangle.h"

namespace sunlit::render::gl {

/// From the largest, 0, to the smallest, inclusive.
struct MaskSizes {
  int largest, smallest;
};

/// Holds all sizes that kMaskedShader chooses for samples within the box of `triangle`, but for rounding at
/// their borders. `texels_factor`: 2^(2 · bias).
MaskSizes maskSizesOf(const ScreenTriangle& triangle, const MaskPlanes& planes, float texels_factor);

}  // namespace sunlit::render::gl
