/// Materials of COLLADA, OBJ, STL and PLY, as Assimp hands them on.
#pragma once

#include <assimp/scene.h>

#include "scene/mesh_material.h"

namespace sunlit::scene {

/// Adds `source`, a material of `scene`, to the builder; what is not rendered of it is a warning.
MeshLook phongLook(const aiMaterial& source, const aiScene& scene, const MeshFileContext& context);

}  // namespace sunlit::scene
