/// A scene as a file for other programs.
#pragma once

#include <string>
#include <vector>

#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// Writes `scene` as binary glTF 2.0 to `file`, whose name should end in .glb: +Y up, m, textures inside as
/// PNG, vertex colours as COLOR_0 (cut off at 1), emission by KHR_materials_emissive_strength, clear glass by
/// KHR_materials_transmission, leaves by KHR_materials_diffuse_transmission, lamps by KHR_lights_punctual,
/// one each, named after its group, at a node with its own name; roughness and metalness in one texture.
/// Material::detail goes into the material's "extras", which load() does not read. Returns what glTF has no
/// word for and what was made of it, a line a kind. The file is there whole or not at all. Throws
/// std::runtime_error naming the file if it cannot be written, and std::invalid_argument as validate() does
/// and for a lamp that is relative.
std::vector<std::string> writeGltf(const Scene& scene, const std::string& file);

}  // namespace sunlit::scene
