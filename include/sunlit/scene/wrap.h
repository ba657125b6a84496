/// Texture coordinates beyond a texture's edges.
#pragma once

#include <algorithm>
#include <cmath>

#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// The place within the texture, 0 … 1, that `coordinate` means.
inline float wrapped(float coordinate, Wrap wrap) {
  if (wrap == Wrap::kClamp) return std::clamp(coordinate, 0.0f, 1.0f);
  if (wrap == Wrap::kRepeat) return coordinate - std::floor(coordinate);
  const float of_two = coordinate - 2.0f * std::floor(0.5f * coordinate);
  return of_two > 1.0f ? 2.0f - of_two : of_two;
}

}  // namespace sunlit::scene
