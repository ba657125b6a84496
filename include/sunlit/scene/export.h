/// A scene as a file for other programs.
#pragma once

#include <string>

#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// Writes `scene` as binary glTF 2.0 to `file`, whose name should end in .glb: +Y up, m, textures inside as
/// PNG, vertex colours as COLOR_0 (cut off at 1), emission by KHR_materials_emissive_strength. What glTF has
/// no word for, Material::detail, goes into the material's "extras". load() reads neither of the last two.
/// The file is there whole or not at all. Throws std::runtime_error naming the file if it cannot be written,
/// and std::invalid_argument as validate() does.
void writeGltf(const Scene& scene, const std::string& file);

}  // namespace sunlit::scene
