/// Primitives of glTF files that are packed (KHR_draco_mesh_compression).
#pragma once

#include <nlohmann/json.hpp>

#include "scene/gltf_buffers.h"

namespace sunlit::scene {

/// Gives the primitives of `root` that Draco packs their triangles and attributes unpacked, in a further
/// buffer, and takes the extension from it: Assimp 5.2 loses indices of 32 bits. Whether there were any;
/// never where this build has no Draco. Vertices are as many as the file tells. Throws std::runtime_error
/// with the extension and the number of the mesh where its data cannot be unpacked, or lack some.
bool unpackDraco(nlohmann::json& root, GltfBuffers& buffers);

}  // namespace sunlit::scene
