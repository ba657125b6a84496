#include "scene/mesh_material.h"

#include <assimp/material.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/color.h"
#include "scene/mesh_file.h"

namespace sunlit::scene {
namespace {

/// None, with a warning, if there is no such file.
std::optional<std::string> textureFile(const std::string& name, const MeshFileContext& context) {
  const Found found = context.finder.findTexture(name, context.file);
  if (!found.file) context.builder.warn(kMissingTextures, name + " of " + context.file);
  if (found.file && found.other_case)
    context.builder.warn(kSpeltOtherwise, name + " of " + context.file + " is " + *found.file);
  return found.file;
}

/// Index of the texture `name`, or kNoTexture with a warning if there is no such file.
int addTexture(const std::string& name, const aiScene& scene, const MeshFileContext& context,
               const Wraps& wraps) {
  if (const aiTexture* embedded = scene.GetEmbeddedTexture(name.c_str())) {
    if (embedded->mHeight != 0) {
      context.builder.warn(
          "textures are embedded as raw texels, which are not read, a neutral material takes their place",
          name + " of " + context.file);
      return Material::kNoTexture;
    }
    const auto* begin = reinterpret_cast<const std::uint8_t*>(embedded->pcData);
    const std::string label = embedded->mFilename.length > 0 ? embedded->mFilename.C_Str() : "";
    return context.builder.textureFromBytes(
        context.file + ": texture " + name + (label.empty() ? "" : " " + label),
        {begin, begin + embedded->mWidth}, wraps);
  }
  const std::optional<std::string> file = textureFile(name, context);
  return file ? context.builder.textureFromFile(*file, wraps) : Material::kNoTexture;
}

/// GetName(), which in Assimp 5.0 is not for constant materials.
std::string nameOf(const aiMaterial& source) {
  aiString name;
  source.Get(AI_MATKEY_NAME, name);
  return name.C_Str();
}

struct Highlight {
  aiColor4D color{0.0f, 0.0f, 0.0f, 1.0f};
  float shininess = 0.0f;
};

/// Dark where the file gives none. Of COLLADA, Assimp hands on a highlight for every effect: for those that
/// have none, and for phong and blinn without the elements for it, the one that its own effects begin with.
Highlight highlightOf(const aiMaterial& source, bool collada) {
  Highlight highlight;
  source.Get(AI_MATKEY_COLOR_SPECULAR, highlight.color);
  source.Get(AI_MATKEY_SHININESS, highlight.shininess);
  if (!collada) return highlight;
  int shading = aiShadingMode_Phong;
  source.Get(AI_MATKEY_SHADING_MODEL, shading);
  const bool matt =
      shading == aiShadingMode_Gouraud || shading == aiShadingMode_NoShading;  // lambert, constant
  const bool of_assimp = highlight.color == aiColor4D(0.4f, 0.4f, 0.4f, 1.0f) && highlight.shininess == 10.0f;
  return matt || of_assimp ? Highlight() : highlight;
}

/// Phong-style materials of COLLADA and OBJ. Their colours are display values.
void readPhong(const aiMaterial& source, bool collada, Material& material) {
  aiColor4D diffuse(0.8f, 0.8f, 0.8f, 1.0f);
  source.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse);
  material.base_color = linearFromSrgb({diffuse.r, diffuse.g, diffuse.b});
  material.roughness = 0.9f;
  const auto [color, shininess] = highlightOf(source, collada);
  const bool shines = std::max({color.r, color.g, color.b}) > 0.0f && shininess > 1.0f;
  if (shines) material.roughness = roughnessOfPhong(shininess);
}

/// Of 0 … 1. An opacity of exactly 0 would make a material pointless; exporters write it when they take
/// COLLADA's transparency the wrong way round.
float opacityOf(const aiMaterial& source) {
  float opacity = 1.0f;
  source.Get(AI_MATKEY_OPACITY, opacity);
  return opacity > 0.0f && opacity < 1.0f ? opacity : 1.0f;
}

Wrap wrapOf(const aiMaterial& source, const char* key, aiTextureType type) {
  int mode = aiTextureMapMode_Wrap;
  source.Get(key, static_cast<unsigned>(type), 0, mode);
  return mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal ? Wrap::kClamp
         : mode == aiTextureMapMode_Mirror                                ? Wrap::kMirror
                                                                          : Wrap::kRepeat;
}

Wraps wrapsOf(const aiMaterial& source, aiTextureType type) {
  return {wrapOf(source, _AI_MATKEY_MAPPINGMODE_U_BASE, type),
          wrapOf(source, _AI_MATKEY_MAPPINGMODE_V_BASE, type)};
}

/// Adds the texture of `type`; kNone if the material has none, or it is missing.
int addTexture(aiTextureType type, const aiMaterial& source, const aiScene& scene,
               const MeshFileContext& context) {
  aiString name;
  if (source.GetTexture(type, 0, &name) != aiReturn_SUCCESS || name.length == 0) return TextureUse::kNone;
  return addTexture(name.C_Str(), scene, context, wrapsOf(source, type));
}

/// What a COLLADA or OBJ file calls the picture of that type; empty: none.
std::string pictureOf(const aiMaterial& source, aiTextureType type) {
  aiString name;
  source.GetTexture(type, 0, &name);
  return name.C_Str();
}

/// The file of a picture of opacity, if that is another than the one of colour.
std::optional<std::string> opacityFile(const aiMaterial& source, const std::string& color,
                                       const aiScene& scene, const MeshFileContext& context) {
  const std::string opacity = pictureOf(source, aiTextureType_OPACITY);
  if (opacity.empty() || opacity == color || scene.GetEmbeddedTexture(opacity.c_str()) != nullptr)
    return std::nullopt;
  return textureFile(opacity, context);
}

/// Colour and opacity. A picture of colour that is missing makes the material neutral.
void readColorMaps(const aiMaterial& source, const aiScene& scene, const MeshFileContext& context,
                   Material& material) {
  const bool base = !pictureOf(source, aiTextureType_BASE_COLOR).empty();
  const aiTextureType type = base ? aiTextureType_BASE_COLOR : aiTextureType_DIFFUSE;
  const std::string color = pictureOf(source, type);
  bool colored = false;
  if (const std::optional<std::string> opacity = opacityFile(source, color, scene, context)) {
    const std::optional<std::string> file = color.empty() ? std::nullopt : textureFile(color, context);
    colored = file.has_value();
    material.base_texture =
        context.builder.textureFromFile(file.value_or(""), wrapsOf(source, type), *opacity);
  } else {
    material.base_texture = addTexture(type, source, scene, context);
    colored = material.base_texture != Material::kNoTexture;
  }
  // The texture stands in the place of the colour.
  if (colored) material.base_color = LinearRgb(1.0f, 1.0f, 1.0f);
  if (!colored && !color.empty()) material.base_color = kNeutral;
}

/// What COLLADA and OBJ say beside colour and highlight: emission is rendered, the rest named.
void readPhongMaps(const aiMaterial& source, const aiScene& scene, const MeshFileContext& context,
                   Material& material) {
  aiColor4D emission(0.0f, 0.0f, 0.0f, 1.0f);
  source.Get(AI_MATKEY_COLOR_EMISSIVE, emission);
  material.emission_map.texture = addTexture(aiTextureType_EMISSIVE, source, scene, context);
  material.emission = material.emission_map.given() ? LinearRgb(1.0f, 1.0f, 1.0f)
                                                    : linearFromBright({emission.r, emission.g, emission.b});
  material.emission.value *= kDisplayWhite_cd_per_m2;
  material.normal_map.texture = addTexture(aiTextureType_NORMALS, source, scene, context);
  const auto name = [&](aiTextureType type, const char* what) {
    if (source.GetTextureCount(type) > 0)
      context.builder.warn(kNotRendered, material.name + " of " + context.file + ": " + what);
  };
  // Assimp may give one picture both ways.
  aiString heights, normals;
  source.GetTexture(aiTextureType_HEIGHT, 0, &heights);
  source.GetTexture(aiTextureType_NORMALS, 0, &normals);
  if (!material.normal_map.given() || !(heights == normals))
    name(aiTextureType_HEIGHT, "a bump map: without it");
  name(aiTextureType_SPECULAR, "a texture of its highlights: without it");
  name(aiTextureType_SHININESS, "a texture of its shininess: without it");
  name(aiTextureType_DISPLACEMENT, "displacement: flat");
  name(aiTextureType_REFLECTION, "a picture of what it mirrors: it mirrors what there is");
}

/// What libraries of OBJ say beyond MTL: roughness and metalness as glTF has them, which come before the
/// highlight. A map stands in the place of the number, as in SDF.
void readRoughMetal(const aiMaterial& source, const aiScene& scene, const MeshFileContext& context,
                    Material& material) {
  // Assimp 5.0 has no names for these keys.
  source.Get("$mat.roughnessFactor", 0, 0, material.roughness);
  source.Get("$mat.metallicFactor", 0, 0, material.metalness);
  material.roughness_map.texture = addTexture(aiTextureType_DIFFUSE_ROUGHNESS, source, scene, context);
  material.metalness_map.texture = addTexture(aiTextureType_METALNESS, source, scene, context);
  if (material.roughness_map.given()) material.roughness = 1.0f;
  if (material.metalness_map.given()) material.metalness = 1.0f;
  // The least of what is no number at all.
  material.roughness = std::fmin(std::fmax(material.roughness, Material::kSmoothest), 1.0f);
  material.metalness = std::fmin(std::fmax(material.metalness, 0.0f), 1.0f);
}

/// Names where COLLADA shifts, turns or repeats textures by extensions of modellers.
void warnOfPlacement(const aiMaterial& source, const std::string& name, const MeshFileContext& context) {
  for (const aiTextureType type :
       {aiTextureType_DIFFUSE, aiTextureType_EMISSIVE, aiTextureType_NORMALS, aiTextureType_OPACITY}) {
    aiUVTransform placed;
    source.Get(_AI_MATKEY_UVTRANSFORM_BASE, static_cast<unsigned>(type), 0, placed);
    const bool identity = placed.mTranslation == aiVector2D(0.0f, 0.0f) &&
                          placed.mScaling == aiVector2D(1.0f, 1.0f) && placed.mRotation == 0.0f;
    if (!identity)
      context.builder.warn(kNotRendered, name + " of " + context.file +
                                             ": textures that are shifted, turned or repeated: without that");
  }
}

/// What Assimp gives a mesh whose file has none.
bool isBare(const aiMaterial& source) {
  return nameOf(source) == AI_DEFAULT_MATERIAL_NAME;
}

bool hasColors(const aiScene& scene) {
  return std::any_of(scene.mMeshes, scene.mMeshes + scene.mNumMeshes,
                     [](const aiMesh* mesh) { return mesh->HasVertexColors(0); });
}

int addPhong(const aiMaterial& source, const aiScene& scene, const MeshFileContext& context) {
  Material material;
  material.name = nameOf(source);
  readPhong(source, extensionOf(context.file) == ".dae", material);
  readColorMaps(source, scene, context, material);
  // STL and PLY come out as white as nothing is.
  if (isBare(source) && material.base_color.value.minCoeff() >= 1.0f && !hasColors(scene))
    material.base_color = kNeutral;
  material.base_color.value = material.base_color.value.max(0.0f).min(1.0f);
  readPhongMaps(source, scene, context, material);
  if (extensionOf(context.file) == ".obj") readRoughMetal(source, scene, context, material);
  if (extensionOf(context.file) == ".dae") warnOfPlacement(source, material.name, context);
  const float opacity = opacityOf(source);
  if (opacity < 0.5f)
    context.builder.warn(
        "materials are more than half transparent; where they should not be, their files mean opacity by it",
        material.name + " of " + context.file);
  const int opaque =
      context.builder.addMaterial(material, AlphaRule::kFromTexture, NormalsRule::kMaybeHeights);
  return context.builder.veiled(opaque, opacity, SceneBuilder::Faces::kOne);
}

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
  if (!context.gltf) {
    const int material = addPhong(source, scene, context);
    const bool fades = context.builder.material(material).alpha_mode != AlphaMode::kOpaque;
    return MeshLook{material, {CoordinateRecipe()}, isBare(source), fades};
  }
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
        return addTexture(name.C_Str(), scene, context, wraps);
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
                         look->material.name + " of " + context.file);
    return std::nullopt;
  }
  return MeshLook{context.builder.addMaterial(look->material, AlphaRule::kDeclared), look->coordinates, false,
                  look->fades};
}

}  // namespace sunlit::scene
