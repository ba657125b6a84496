/// Attributes that glTF may write as whole numbers; Assimp takes their bytes for those of floats.
#pragma once

#include <nlohmann/json.hpp>

#include "scene/gltf_buffers.h"

namespace sunlit::scene {

/// Gives positions, normals, tangents, texture coordinates and weights the floats that their whole numbers
/// stand for (glTF 2.0, sections 3.6.2.2 and 3.7.2.1, and KHR_mesh_quantization): their accessors in `root`
/// then refer to a further buffer. Whether there were any. Throws as floatsOf().
bool useFloats(nlohmann::json& root, GltfBuffers& buffers);

}  // namespace sunlit::scene
