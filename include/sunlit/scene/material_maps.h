/// The textures of a material that are used alike.
#pragma once

#include <array>

#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// All maps of `material` but its base texture.
inline std::array<TextureUse*, 5> mapsOf(Material& material) {
  return {&material.roughness_map, &material.metalness_map, &material.normal_map, &material.occlusion_map,
          &material.emission_map};
}

}  // namespace sunlit::scene
