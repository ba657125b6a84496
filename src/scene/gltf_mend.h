/// Oddities of glTF files that Assimp refuses, though they mean something, or nothing at all.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>

#include "scene/gltf_buffers.h"

namespace sunlit::scene {

/// What was changed.
struct GltfMends {
  std::size_t extras = 0;      ///< of other types than objects, which glTF 2.0 allows, left out
  std::size_t primitives = 0;  ///< of too few corners for a triangle, line or point, left out
  std::size_t turns = 0;       ///< of nodes, whose quaternions would have scaled them
  bool scene = false;          ///< there was none: now there is one of all nodes

  bool any() const { return extras > 0 || primitives > 0 || turns > 0 || scene; }
};

GltfMends mendGltf(nlohmann::json& root);

/// Gives accessors of shapes that are in no view, and so all of zeros (glTF 2.0, section 3.6.2.2), one of
/// those. Whether there were any. Throws std::runtime_error with the number of one that is too large.
bool giveZeros(nlohmann::json& root, GltfBuffers& buffers);

/// Makes quaternions of nodes that are not of length 1 such ones, of no turn where they are zero: how many.
std::size_t makeUnit(nlohmann::json& root);

}  // namespace sunlit::scene
