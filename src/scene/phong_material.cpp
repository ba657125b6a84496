#include "scene/phong_material.h"

#include <assimp/material.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "scene/clear_coat.h"
#include "scene/collada_text.h"
#include "scene/color.h"
#include "scene/mesh_file.h"
#include "scene/mesh_texture.h"

namespace sunlit::scene {
namespace {

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

/// Of 0 … 1. An opacity of exactly 0 would make a material pointless; exporters write it when they take
/// COLLADA's transparency the wrong way round.
float opacityOf(const aiMaterial& source) {
  float opacity = 1.0f;
  source.Get(AI_MATKEY_OPACITY, opacity);
  return opacity > 0.0f && opacity < 1.0f ? opacity : 1.0f;
}

/// Which set of coordinates the texture of `type` wants; of COLLADA the first number in what the effect calls
/// them, see withKnownSets().
CoordinateRecipe recipeOf(const aiMaterial& source, aiTextureType type) {
  CoordinateRecipe recipe;
  source.Get(_AI_MATKEY_UVWSRC_BASE, static_cast<unsigned>(type), 0, recipe.set);
  return recipe;
}

/// What a COLLADA or OBJ file calls the picture of that type; empty: none.
std::string pictureOf(const aiMaterial& source, aiTextureType type) {
  aiString name;
  source.GetTexture(type, 0, &name);
  return name.C_Str();
}

bool isOfLibrary(const aiMaterial& source, const MeshFileContext& context) {
  return context.obj_materials.count(nameOf(source)) == 1;
}

/// What Assimp 5.2 makes for a PLY file without materials: as those that such a file has, it has no name.
bool isOfBarePly(const aiMaterial& source) {
  aiColor4D diffuse, specular;
  source.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse);
  source.Get(AI_MATKEY_COLOR_SPECULAR, specular);
  const auto least = [](const aiColor4D& color) { return std::min({color.r, color.g, color.b}); };
  return nameOf(source).empty() && pictureOf(source, aiTextureType_DIFFUSE).empty() &&
         std::min(least(diffuse), least(specular)) >= 1.0f;
}

/// Whether Assimp gave it to a mesh whose file has none: files may call theirs alike.
bool isBare(const aiMaterial& source, const MeshFileContext& context) {
  const std::string extension = extensionOf(context.file);
  if (extension == ".dae" && nameOf(source) == kBareMaterial) return true;
  if (extension == ".ply" && isOfBarePly(source)) return true;
  if (nameOf(source) != AI_DEFAULT_MATERIAL_NAME || isOfLibrary(source, context)) return false;
  int shading = 0;  // which all effects of COLLADA have
  return extension != ".dae" || source.Get(AI_MATKEY_SHADING_MODEL, shading) != aiReturn_SUCCESS;
}

/// Whether its colour is Assimp's own, or that of a header of STL, which Assimp takes where no face seems to
/// have one. PLY may have one, and comes out as white as nothing is where it has none.
bool isInvented(const aiMaterial& source, const MeshFileContext& context) {
  const std::string extension = extensionOf(context.file);
  if (extension == ".obj") return !isOfLibrary(source, context);
  if (extension == ".stl") return true;
  aiColor4D color(1.0f, 1.0f, 1.0f, 1.0f);
  source.Get(AI_MATKEY_COLOR_DIFFUSE, color);
  return isBare(source, context) && (extension == ".dae" || std::min({color.r, color.g, color.b}) >= 1.0f);
}

/// A <constant> of COLLADA.
bool isUnlit(const aiMaterial& source) {
  int shading = aiShadingMode_Phong;
  source.Get(AI_MATKEY_SHADING_MODEL, shading);
  return shading == aiShadingMode_NoShading;
}

bool hasEmission(const aiMaterial& source) {
  aiColor4D emission(0.0f, 0.0f, 0.0f, 1.0f);
  source.Get(AI_MATKEY_COLOR_EMISSIVE, emission);
  return !emission.IsBlack() || !pictureOf(source, aiTextureType_EMISSIVE).empty();
}

/// That is the colour of those; some files write a diffuse one, which counts where there is no emission.
bool isColoredByEmission(const aiMaterial& source) {
  return isUnlit(source) && hasEmission(source);
}

/// Of COLLADA, where Assimp has a grey of its own; another material may be called alike.
bool lacksDiffuse(const aiMaterial& source, const MeshFileContext& context) {
  aiColor4D color;
  source.Get(AI_MATKEY_COLOR_DIFFUSE, color);
  return context.effects.without_diffuse.count(nameOf(source)) == 1 &&
         color == aiColor4D(0.6f, 0.6f, 0.6f, 1.0f) && pictureOf(source, aiTextureType_DIFFUSE).empty();
}

bool hasColors(const aiScene& scene) {
  return std::any_of(scene.mMeshes, scene.mMeshes + scene.mNumMeshes,
                     [](const aiMesh* mesh) { return mesh->HasVertexColors(0); });
}

/// Makes a look of one material.
class PhongReader {
 public:
  PhongReader(const aiMaterial& source, const aiScene& scene, const MeshFileContext& context)
      : source_(source),
        scene_(scene),
        context_(context),
        extension_(extensionOf(context.file)),
        by_emission_(extension_ == ".dae" && isColoredByEmission(source)) {
    material_.name = nameOf(source);
  }

  MeshLook read() {
    readColors();
    readColorMaps();
    replaceInvented();
    material_.base_color.value = material_.base_color.value.max(0.0f).min(1.0f);
    readMaps();
    const float opacity = transparency() != nullptr ? 1.0f : opacityOf(source_);
    if (extension_ == ".obj") {
      readRoughMetal();
      nameRestOfObj(opacity);
    } else if (extension_ == ".dae") {
      if (isUnlit(source_)) warnOf("<constant>, a colour without any light: lit like any other");
      warnOfPlacement();
      nameReflection();
      nameIndex(opacity < 1.0f);
    }
    if (opacity < 0.5f)
      context_.builder.warn(
          "materials are more than half transparent; where they should not be, their files mean opacity by "
          "it",
          material_.name + " of " + context_.file);
    const bool asks = !pictureOf(source_, aiTextureType_OPACITY).empty();
    const int opaque = context_.builder.addMaterial(
        material_, asks ? AlphaRule::kFromTexture : AlphaRule::kNotAskedFor, NormalsRule::kMaybeHeights);
    const int material = context_.builder.veiled(opaque, opacity, SceneBuilder::Faces::kOne);
    const bool fades = context_.builder.material(material).alpha_mode != AlphaMode::kOpaque;
    return {material, coordinates_, isBare(source_, context_), fades};
  }

 private:
  void warnOf(const std::string& lost) {
    context_.builder.warn(kNotRendered, material_.name + " of " + context_.file + ": " + lost);
  }

  /// Phong's; they are display values.
  void readColors() {
    aiColor4D diffuse(0.8f, 0.8f, 0.8f, 1.0f);
    if (by_emission_)
      source_.Get(AI_MATKEY_COLOR_EMISSIVE, diffuse);
    else
      source_.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse);
    material_.base_color = linearFromSrgb({diffuse.r, diffuse.g, diffuse.b});
    material_.roughness = 0.9f;
    const auto [color, shininess] = highlightOf(source_, extension_ == ".dae");
    const bool shines = std::max({color.r, color.g, color.b}) > 0.0f && shininess > 1.0f;
    if (shines) material_.roughness = roughnessOfPhong(shininess);
  }

  /// What stands for a colour of Assimp's own. COLLADA 1.4 adds up the terms that an effect has: of one that
  /// shines, but scatters nothing, that is black. Others are as meshes without a material.
  void replaceInvented() {
    const bool lacks = !by_emission_ && lacksDiffuse(source_, context_);
    if (!lacks && !isInvented(source_, context_)) return;
    const bool is_black = lacks && hasEmission(source_);
    material_.base_color = hasColors(scene_) ? LinearRgb(1.0f, 1.0f, 1.0f)
                           : is_black        ? LinearRgb(0.0f, 0.0f, 0.0f)
                                             : kNeutral;
  }

  /// The texture of that type; kNone if there is none, or it is missing.
  int addTexture(aiTextureType type) {
    const std::string name = pictureOf(source_, type);
    return name.empty() ? TextureUse::kNone : addMeshTexture(name, scene_, context_, wrapsOf(source_, type));
  }

  TextureUse addMap(aiTextureType type) {
    const int texture = addTexture(type);
    if (texture == TextureUse::kNone) return {};
    const CoordinateRecipe recipe = recipeOf(source_, type);
    const auto same = std::find(coordinates_.begin(), coordinates_.end(), recipe);
    const auto index = static_cast<int>(same - coordinates_.begin());
    if (same == coordinates_.end()) coordinates_.push_back(recipe);
    return {texture, index};
  }

  /// How its picture of transparency is meant, where that is no opacity; null elsewhere.
  const OpacityPicture* transparency() const {
    const auto found = context_.effects.transparency.find(material_.name);
    return found == context_.effects.transparency.end() ? nullptr : &found->second;
  }

  /// A picture of opacity, if that is another than the one of colour.
  std::optional<OpacityPicture> opacityPicture(aiTextureType color_type) {
    const std::string opacity = pictureOf(source_, aiTextureType_OPACITY),
                      color = pictureOf(source_, color_type);
    if (!opacity.empty() && opacity == color && transparency() != nullptr)
      warnOf("a picture of colour that is one of transparency, too: its alpha is an opacity");
    if (opacity.empty() || opacity == color || scene_.GetEmbeddedTexture(opacity.c_str()) != nullptr)
      return std::nullopt;
    if (!color.empty() && !(recipeOf(source_, aiTextureType_OPACITY) == recipeOf(source_, color_type)))
      warnOf("texture coordinates of its picture of opacity: those of the colour");
    OpacityPicture picture = transparency() != nullptr ? *transparency() : OpacityPicture();
    const std::optional<std::string> file = textureFile(opacity, context_);
    if (!file) return std::nullopt;
    picture.file = *file;
    return picture;
  }

  /// What stands beside a picture: of OBJ the colour multiplies it, as MTL, OGRE (Gazebo, RViz) and three.js
  /// have it. Of COLLADA there is none.
  LinearRgb factorOf(const LinearRgb& color) const {
    return extension_ == ".obj" ? factorBesidePicture(color) : LinearRgb(1.0f, 1.0f, 1.0f);
  }

  /// Colour and opacity. A picture of colour that is missing makes the material neutral.
  void readColorMaps() {
    const bool base = !pictureOf(source_, aiTextureType_BASE_COLOR).empty();
    const aiTextureType type = by_emission_ ? aiTextureType_EMISSIVE
                               : base       ? aiTextureType_BASE_COLOR
                                            : aiTextureType_DIFFUSE;
    const std::string color = pictureOf(source_, type);
    bool colored = false;
    coordinates_ = {recipeOf(source_, color.empty() ? aiTextureType_OPACITY : type)};
    if (const std::optional<OpacityPicture> opacity = opacityPicture(type)) {
      const std::optional<std::string> file = color.empty() ? std::nullopt : textureFile(color, context_);
      colored = file.has_value();
      material_.base_texture =
          context_.builder.textureFromFile(file.value_or(""), wrapsOf(source_, type), *opacity);
    } else {
      material_.base_texture = addTexture(type);
      colored = material_.base_texture != Material::kNoTexture;
    }
    if (colored) material_.base_color = factorOf(material_.base_color);
    if (!colored && !color.empty()) material_.base_color = kNeutral;
  }

  void readEmission() {
    aiColor4D emission(0.0f, 0.0f, 0.0f, 1.0f);
    source_.Get(AI_MATKEY_COLOR_EMISSIVE, emission);
    material_.emission_map = addMap(aiTextureType_EMISSIVE);
    material_.emission = linearFromBright({emission.r, emission.g, emission.b});
    if (material_.emission_map.given())
      material_.emission = factorOf(material_.emission);
    else if (!pictureOf(source_, aiTextureType_EMISSIVE).empty())
      material_.emission = LinearRgb();  // not all over
    material_.emission.value *= kDisplayWhite_cd_per_m2;
  }

  /// What there is beside colour and highlight: emission is rendered, the rest named.
  void readMaps() {
    if (!by_emission_) readEmission();
    material_.normal_map = addMap(aiTextureType_NORMALS);
    const auto name = [&](aiTextureType type, const char* what) {
      if (source_.GetTextureCount(type) > 0) warnOf(what);
    };
    // Assimp may give one picture both ways.
    if (!material_.normal_map.given() ||
        pictureOf(source_, aiTextureType_HEIGHT) != pictureOf(source_, aiTextureType_NORMALS))
      name(aiTextureType_HEIGHT, "a bump map: without it");
    name(aiTextureType_SPECULAR, "a texture of its highlights: without it");
    name(aiTextureType_SHININESS, "a texture of its shininess: without it");
    name(aiTextureType_DISPLACEMENT, "displacement: flat");
    name(aiTextureType_REFLECTION, "a picture of what it mirrors: it mirrors what there is");
  }

  /// What libraries of OBJ say beyond MTL: roughness and metalness as glTF has them, which come before the
  /// highlight. A map stands in the place of the number, as in SDF.
  void readRoughMetal() {
    // Assimp 5.0 has no names for these keys.
    source_.Get("$mat.roughnessFactor", 0, 0, material_.roughness);
    source_.Get("$mat.metallicFactor", 0, 0, material_.metalness);
    material_.roughness_map = addMap(aiTextureType_DIFFUSE_ROUGHNESS);
    material_.metalness_map = addMap(aiTextureType_METALNESS);
    if (material_.roughness_map.given()) material_.roughness = 1.0f;
    if (material_.metalness_map.given()) material_.metalness = 1.0f;
    // The least of what is no number at all.
    material_.roughness = std::fmin(std::fmax(material_.roughness, Material::kSmoothest), 1.0f);
    material_.metalness = std::fmin(std::fmax(material_.metalness, 0.0f), 1.0f);
    ClearCoat coat;
    source_.Get("$mat.clearcoat.factor", 0, 0, coat.factor);
    source_.Get("$mat.clearcoat.roughnessFactor", 0, 0, coat.roughness);
    if (!addClearCoat(coat, &material_)) warnOf(kLostCoat);
  }

  /// Of refraction. 1 is what there is where a file says nothing.
  void nameIndex(bool is_transparent) {
    constexpr float kUsual = 1.5f;
    constexpr float kAlike = 0.1001f;  // from 1.4 to 1.6 as floats; changes the reflectance by 0.0133 at most
    float index = 1.0f;
    source_.Get(AI_MATKEY_REFRACTI, index);
    if (!(index > 1.0f)) return;
    if (is_transparent)
      warnOf("an index of refraction: what is behind is not bent");
    else if (!(std::abs(index - kUsual) <= kAlike))
      warnOf("an index of refraction: it mirrors by one of 1.5");
  }

  /// What MTL says beyond colours, and the bits of it that mean nothing else.
  void nameRestOfObj(float opacity) {
    int model = 2;
    source_.Get("$mat.illum", 0, 0, model);  // Assimp 5.0 has no name for it, and does not hand it on
    const std::string illum = "illum " + std::to_string(model);
    const bool is_glass = model == 4 || model == 6 || model == 7 || model == 9;
    const bool mirrors = model == 3 || model == 5 || model == 8;
    aiColor4D specular(0.0f, 0.0f, 0.0f, 1.0f), filter(1.0f, 1.0f, 1.0f, 1.0f);
    aiColor4D sheen(0.0f, 0.0f, 0.0f, 1.0f);
    source_.Get(AI_MATKEY_COLOR_SPECULAR, specular);
    source_.Get(AI_MATKEY_COLOR_TRANSPARENT, filter);
    source_.Get("$clr.sheen.factor", 0, 0, sheen);
    if (model == 0) warnOf(illum + ", a colour without any light: lit like any other");
    if (is_glass && opacity >= 1.0f) warnOf(illum + ", glass: drawn as opaque");
    if (mirrors && material_.metalness <= 0.0f && !specular.IsBlack())
      warnOf(illum + ", a mirror by Ks: it mirrors as paint does");
    if (model == 10) warnOf(illum + ", nothing but the shadows on it: drawn like any other");
    const bool is_transparent = is_glass || opacity < 1.0f;
    nameIndex(is_transparent);
    if (is_transparent && !filter.IsBlack() && filter != aiColor4D(1.0f, 1.0f, 1.0f, filter.a))
      warnOf("Tf, the colour of what passes through: all colours pass alike");
    const std::string ambient = pictureOf(source_, aiTextureType_AMBIENT);
    if (!ambient.empty() && ambient != pictureOf(source_, aiTextureType_DIFFUSE))
      warnOf("map_Ka, a picture of ambient light: light is computed");
    if (!sheen.IsBlack()) warnOf("a sheen: without it");
  }

  /// Of COLLADA: a share, of a colour.
  void nameReflection() {
    aiColor4D color(0.0f, 0.0f, 0.0f, 0.0f);
    float share = 0.0f;
    source_.Get(AI_MATKEY_COLOR_REFLECTIVE, color);
    source_.Get(AI_MATKEY_REFLECTIVITY, share);
    if (share > 0.0f && std::max({color.r, color.g, color.b}) > 0.0f)
      warnOf("<reflective>, a share that it mirrors: it mirrors as paint does");
  }

  /// Names where COLLADA shifts, turns or repeats textures by extensions of modellers.
  void warnOfPlacement() {
    for (const aiTextureType type :
         {aiTextureType_DIFFUSE, aiTextureType_EMISSIVE, aiTextureType_NORMALS, aiTextureType_OPACITY}) {
      aiUVTransform placed;
      source_.Get(_AI_MATKEY_UVTRANSFORM_BASE, static_cast<unsigned>(type), 0, placed);
      const bool identity = placed.mTranslation == aiVector2D(0.0f, 0.0f) &&
                            placed.mScaling == aiVector2D(1.0f, 1.0f) && placed.mRotation == 0.0f;
      if (!identity) warnOf("textures that are shifted, turned or repeated: without that");
    }
  }

  const aiMaterial& source_;
  const aiScene& scene_;
  const MeshFileContext& context_;
  const std::string extension_;
  const bool by_emission_;  ///< its colour is
  Material material_;
  std::vector<CoordinateRecipe> coordinates_;  ///< of MeshLook
};

}  // namespace

MeshLook phongLook(const aiMaterial& source, const aiScene& scene, const MeshFileContext& context) {
  return PhongReader(source, scene, context).read();
}

}  // namespace sunlit::scene
