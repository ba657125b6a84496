#include "scene/mesh_material.h"

#include <assimp/material.h>

#include "scene/mesh_texture.h"
#include "scene/phong_material.h"

namespace sunlit::scene {
namespace {

aiTextureType typeOf(GltfMaterials::Slot slot) {
  switch (slot) {
    case GltfMaterials::Slot::kBase:
      return aiTextureType_BASE_COLOR;
    case GltfMaterials::Slot::kDiffuse:
      return aiTextureType_DIFFUSE;
    case GltfMaterials::Slot::kMetallicRoughness:
      return aiTextureType_UNKNOWN;
    case GltfMaterials::Slot::kNormal:
      return aiTextureType_NORMALS;
    case GltfMaterials::Slot::kOcclusion:
      return aiTextureType_LIGHTMAP;
    case GltfMaterials::Slot::kEmissive:
      return aiTextureType_EMISSIVE;
  }
  return aiTextureType_NONE;
}

/// Empty where there is none. Assimp 5.0 calls the base a diffuse colour.
aiString textureOf(const aiMaterial& source, GltfMaterials::Slot slot) {
  aiString name;
  if (source.GetTexture(typeOf(slot), 0, &name) == aiReturn_SUCCESS && name.length > 0) return name;
  if (slot != GltfMaterials::Slot::kBase ||
      source.GetTexture(aiTextureType_DIFFUSE, 0, &name) != aiReturn_SUCCESS)
    return aiString();
  return name;
}

}  // namespace

std::optional<MeshLook> addMeshMaterial(unsigned index, const aiScene& scene,
                                        const MeshFileContext& context) {
  const aiMaterial& source = *scene.mMaterials[index];
  if (!context.gltf) return phongLook(source, scene, context);
  const std::optional<GltfLook> look =
      context.gltf->look(context.gltf_order.at(index), [&](GltfMaterials::Slot slot, const Wraps& wraps) {
        const aiString name = textureOf(source, slot);
        if (name.length == 0) {
          const std::string material = nameOf(source);
          context.builder.warn(
              kMissingTextures,
              "one of " + (material.empty() ? "a material" : "material " + material) + " of " + context.file);
          return TextureUse::kNone;
        }
        return addMeshTexture(name.C_Str(), scene, context, wraps);
      });
  if (!look) {  // glTF 2.0, section 3.7.2.1: the default material
    Material material;
    material.name = "default";
    material.base_color = LinearRgb(1.0f, 1.0f, 1.0f);
    material.roughness = 1.0f;
    material.metalness = 1.0f;
    material.double_sided = false;
    return MeshLook{context.builder.addMaterial(material, AlphaRule::kDeclared), {CoordinateRecipe()}, true};
  }
  if (look->vanishes) {
    context.builder.warn("materials are invisible by their alpha, and left out",
                         context.gltf->nameOf(context.gltf_order.at(index)) + " of " + context.file);
    return std::nullopt;
  }
  return MeshLook{context.builder.addMaterial(look->material, AlphaRule::kDeclared), look->coordinates, false,
                  look->fades};
}

}  // namespace sunlit::scene
