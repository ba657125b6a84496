/// Assimp's materials as ours.
#pragma once

#include <assimp/scene.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scene/collada_effects.h"
#include "scene/gltf_material.h"
#include "scene/resource_finder.h"
#include "scene/scene_builder.h"

namespace sunlit::scene {

/// A mesh file being read.
struct MeshFileContext {
  std::string file;
  const GltfMaterials* gltf;  ///< null: COLLADA or OBJ, whose materials mean other things
  const ResourceFinder& finder;
  SceneBuilder& builder;
  std::vector<std::size_t> gltf_order = {};  ///< GltfMaterials::order() of a glTF file
  std::vector<std::string> libraries =
      {};  ///< of materials of an OBJ file, beside which pictures may be, too
  std::set<std::string> obj_materials = {};  ///< names of those that these libraries have
  ColladaEffects effects = {};               ///< of a COLLADA file
};

/// A material in the builder, and the texture coordinates that it wants of its meshes.
struct MeshLook {
  int material;
  std::vector<CoordinateRecipe> coordinates;  ///< the first is Mesh::texture_coordinates
  bool bare = false;                          ///< MeshPart::bare
  bool fades = false;                         ///< alpha counts, that of its vertices, too
};

/// Adds material `index` of `scene` to the builder. A missing texture is a warning and a neutral grey. None,
/// with a warning, if nothing of it would be seen.
std::optional<MeshLook> addMeshMaterial(unsigned index, const aiScene& scene, const MeshFileContext& context);

}  // namespace sunlit::scene
