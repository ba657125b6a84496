/// Textures that let nothing through.
#pragma once

#include <cstddef>

#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// Whether all of its texels are opaque. Looks at each until one is not.
inline bool isWhole(const Texture& texture) {
  for (std::size_t i = 3; i < texture.rgba.size(); i += 4)
    if (texture.rgba[i] < 255) return false;
  return true;
}

}  // namespace sunlit::scene
