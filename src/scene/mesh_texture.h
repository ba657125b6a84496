/// Textures of meshes that Assimp has read.
#pragma once

#include <assimp/scene.h>

#include <optional>
#include <string>

#include "scene/mesh_material.h"

namespace sunlit::scene {

/// The file of a picture; none, with a warning, if there is no such.
std::optional<std::string> textureFile(const std::string& name, const MeshFileContext& context);

/// Index in the builder of the texture `name`, embedded or in a file, or kNoTexture with a warning if there
/// is no such.
int addMeshTexture(const std::string& name, const aiScene& scene, const MeshFileContext& context,
                   const Wraps& wraps);

/// GetName(), which in Assimp 5.0 is not for constant materials.
std::string nameOf(const aiMaterial& source);

/// How the texture of that type goes on beyond its edges.
Wraps wrapsOf(const aiMaterial& source, aiTextureType type);

}  // namespace sunlit::scene
