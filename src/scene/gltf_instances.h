/// Meshes that one node of a glTF file shows many times.
#pragma once

#include <nlohmann/json.hpp>

#include "scene/gltf_buffers.h"

namespace sunlit::scene {

/// Gives each node whose mesh is shown at many places (EXT_mesh_gpu_instancing) a node below it for each of
/// these, in `root`. Whether there were any. Throws std::runtime_error where the attributes of a node do not
/// tell equally many places, or too many, and as floatsOf().
bool placeInstances(nlohmann::json& root, GltfBuffers& buffers);

}  // namespace sunlit::scene
