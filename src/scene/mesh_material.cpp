#include "scene/mesh_material.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "scene/color.h"

namespace sunlit::scene {
namespace {

std::optional<std::string> textureName(const aiMaterial& source) {
  for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
    aiString name;
    if (source.GetTexture(type, 0, &name) == aiReturn_SUCCESS && name.length > 0) return name.C_Str();
  }
  return std::nullopt;
}

/// Index of the texture `name`, or kNoTexture with a warning if there is no such file.
int addTexture(const std::string& name, const aiScene& scene, const MeshFileContext& context) {
  if (const aiTexture* embedded = scene.GetEmbeddedTexture(name.c_str())) {
    if (embedded->mHeight != 0) {
      context.builder.warn(context.file + ": texture " + name +
                           " is embedded as raw texels, which is not supported");
      return Material::kNoTexture;
    }
    const auto* begin = reinterpret_cast<const std::uint8_t*>(embedded->pcData);
    const std::string label = embedded->mFilename.length > 0 ? embedded->mFilename.C_Str() : "";
    return context.builder.textureFromBytes(
        context.file + ": texture " + name + (label.empty() ? "" : " " + label),
        {begin, begin + embedded->mWidth});
  }
  const Found found = context.finder.findTexture(name, context.file);
  if (!found.file) {
    context.builder.warn(kMissingTextures, name + " of " + context.file);
    return Material::kNoTexture;
  }
  if (found.other_case) {
    context.builder.warn(kSpeltOtherwise, name + " of " + context.file + " is " + *found.file);
  }
  return context.builder.textureFromFile(*found.file);
}

/// glTF 2.0's own metallic-roughness properties.
void readGltf(const aiMaterial& source, Material& material) {
  aiColor4D base;
  if (source.Get(AI_MATKEY_BASE_COLOR, base) == aiReturn_SUCCESS) {
    material.base_color = LinearRgb(base.r, base.g, base.b);
  }
  aiColor3D emission;
  if (source.Get(AI_MATKEY_COLOR_EMISSIVE, emission) == aiReturn_SUCCESS) {
    material.emission = LinearRgb(emission.r, emission.g, emission.b);
  }
  material.roughness = 1.0f;  // glTF's defaults are 1 and 1
  material.metalness = 1.0f;
  source.Get(AI_MATKEY_ROUGHNESS_FACTOR, material.roughness);
  source.Get(AI_MATKEY_METALLIC_FACTOR, material.metalness);
  material.roughness = std::clamp(material.roughness, Material::kSmoothest, 1.0f);
  material.metalness = std::clamp(material.metalness, 0.0f, 1.0f);
}

/// The alpha mode of a glTF material; blending, which we do not have, becomes a cut-out.
void readGltfAlpha(const aiMaterial& source, Material& material, const MeshFileContext& context) {
  aiString mode;
  source.Get(AI_MATKEY_GLTF_ALPHAMODE, mode);
  source.Get(AI_MATKEY_GLTF_ALPHACUTOFF, material.alpha_cutoff);
  material.alpha_cutoff = std::clamp(material.alpha_cutoff, 0.0f, 1.0f);
  if (std::strcmp(mode.C_Str(), "MASK") == 0) material.alpha_mode = AlphaMode::kMask;
  if (std::strcmp(mode.C_Str(), "BLEND") == 0) {
    material.alpha_mode = AlphaMode::kMask;
    material.alpha_cutoff = 0.5f;
    context.builder.warn("materials are blended, they are cut out at alpha 0.5",
                         material.name + " of " + context.file);
  }
}

/// Phong-style materials of COLLADA and OBJ. Their colours are display values.
void readPhong(const aiMaterial& source, Material& material) {
  aiColor4D diffuse(0.8f, 0.8f, 0.8f, 1.0f);
  source.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse);
  material.base_color = linearFromSrgb({diffuse.r, diffuse.g, diffuse.b});
  material.roughness = 0.9f;
  aiColor4D specular(0.0f, 0.0f, 0.0f, 1.0f);
  float shininess = 0.0f;
  source.Get(AI_MATKEY_COLOR_SPECULAR, specular);
  source.Get(AI_MATKEY_SHININESS, shininess);
  const bool shines = std::max({specular.r, specular.g, specular.b}) > 0.0f && shininess > 1.0f;
  if (shines) material.roughness = roughnessOfPhong(shininess);
}

/// An opacity of exactly 0 would make a material pointless; exporters write it when they take COLLADA's
/// transparency the wrong way round.
bool isSeenThrough(const aiMaterial& source) {
  float opacity = 1.0f;
  source.Get(AI_MATKEY_OPACITY, opacity);
  return opacity > 0.0f && opacity < 0.5f;
}

}  // namespace

std::optional<int> addMeshMaterial(const aiMaterial& source, const aiScene& scene,
                                   const MeshFileContext& context) {
  Material material;
  material.name = source.GetName().C_Str();
  const bool gltf = context.is_gltf;
  if (isSeenThrough(source)) {
    context.builder.warn("materials are more than half transparent, what has them was left out",
                         material.name + " of " + context.file);
    return std::nullopt;
  }
  if (gltf) {
    readGltf(source, material);
    readGltfAlpha(source, material, context);
  } else {
    readPhong(source, material);
  }
  int double_sided = gltf ? 0 : 1;
  source.Get(AI_MATKEY_TWOSIDED, double_sided);
  material.double_sided = !gltf || double_sided != 0;
  if (const auto name = textureName(source)) {
    material.base_texture = addTexture(*name, scene, context);
    const bool missing = material.base_texture == Material::kNoTexture;
    // In COLLADA and OBJ the texture stands in the place of the colour; in glTF it multiplies it.
    if (missing) material.base_color = kNeutral;
    if (!missing && !gltf) material.base_color = LinearRgb(1.0f, 1.0f, 1.0f);
    if (missing) material.alpha_mode = AlphaMode::kOpaque;
  }
  material.base_color.value = material.base_color.value.max(0.0f).min(1.0f);
  return context.builder.addMaterial(material, gltf ? AlphaRule::kDeclared : AlphaRule::kFromTexture);
}

}  // namespace sunlit::scene
