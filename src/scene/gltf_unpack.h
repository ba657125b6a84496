/// Buffer views of glTF files that are packed (EXT_meshopt_compression, KHR_meshopt_compression).
#pragma once

#include <nlohmann/json.hpp>

#include "scene/gltf_buffers.h"

namespace sunlit::scene {

/// Whether this build has the library that unpacks them.
bool unpacks();

/// Makes the buffers of `root` that are nowhere but in packed views; views that are packed and beside it
/// there unpacked, too, are left as they are. Whether there were any; never where this build does not unpack.
/// Throws std::runtime_error with the extension and the number of a view that is not as the extension has it.
bool unpackViews(nlohmann::json& root, GltfBuffers& buffers);

}  // namespace sunlit::scene
