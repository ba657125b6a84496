/// A clear layer of lacquer over a surface, which has but one gloss here.
#pragma once

#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// As KHR_materials_clearcoat means it: a dielectric of an index of 1.5.
struct ClearCoat {
  float factor = 0.0f;     ///< share of the surface that it covers, 0 … 1
  float roughness = 0.0f;  ///< 0 … 1
};

constexpr const char* kLostCoat = "a clear coat that mirrors less than what it covers: without it";

/// Gives `material`, whose textures are read, the gloss of its coat, where that mirrors more than what it
/// covers: between two dielectrics of one index nothing is mirrored, so that paint and plastics have no other
/// gloss beneath a coat. Metal does, and keeps its own, unless it is as dark: false, the coat is lost.
bool addClearCoat(const ClearCoat& coat, Material* material);

}  // namespace sunlit::scene
