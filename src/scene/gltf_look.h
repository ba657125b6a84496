/// One material of a glTF file.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/gltf_material.h"

namespace sunlit::scene {

/// Whether the extension is one of materials that gltfLook() renders or names.
bool isKnownOfMaterials(const std::string& extension);

/// What the object `source` of "materials" means; `root` is all of the file. What cannot be shown, and what
/// is made of it, is appended to `lost`. Throws std::exception where the object is not as glTF has it.
GltfLook gltfLook(const nlohmann::json& root, const nlohmann::json& source,
                  const GltfMaterials::Picture& picture, std::vector<std::string>* lost);

}  // namespace sunlit::scene
