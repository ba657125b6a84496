/// Assimp's materials as ours.
#pragma once

#include <assimp/scene.h>

#include <optional>
#include <string>

#include "scene/resource_finder.h"
#include "scene/scene_builder.h"

namespace sunlit::scene {

/// A mesh file being read.
struct MeshFileContext {
  std::string file;
  bool is_gltf;  ///< else COLLADA or OBJ, whose materials mean other things
  const ResourceFinder& finder;
  SceneBuilder& builder;
};

/// Adds `source`, a material of `scene`, to the builder and gives its index there. A missing texture is a
/// warning and a neutral grey. None, with a warning, if it is more than half transparent: we have surfaces
/// and holes, nothing between.
std::optional<int> addMeshMaterial(const aiMaterial& source, const aiScene& scene,
                                   const MeshFileContext& context);

}  // namespace sunlit::scene
