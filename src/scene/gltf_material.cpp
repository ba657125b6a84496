#include "scene/gltf_material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

#include "scene/color.h"
#include "scene/gltf_check.h"
#include "scene/gltf_input.h"
#include "scene/gltf_json.h"
#include "scene/gltf_rest.h"
#include "scene/gltf_unpack.h"

namespace sunlit::scene {
namespace {

using nlohmann::json;

bool has(const json& from, const char* key) {
  return from.find(key) != from.end();
}

LinearRgb color(const json& from, const char* key, const LinearRgb& usual) {
  const json& value = child(from, key);
  if (!value.is_array() || value.size() < 3) return usual;
  LinearRgb result;
  for (int c = 0; c < 3; ++c) result.value[c] = value.at(static_cast<std::size_t>(c)).get<float>();
  return result;
}

LinearRgb clamped(LinearRgb color) {
  color.value = color.value.max(0.0f).min(1.0f);
  return color;
}

float within(float value, float low, float high) {
  return std::isfinite(value) ? std::clamp(value, low, high) : high;
}

// glTF 2.0, section 5.26.
Wrap wrapOf(const json& sampler, const char* key) {
  constexpr std::size_t kClampToEdge = 33071, kMirroredRepeat = 33648, kRepeat = 10497;
  const std::size_t mode = indexOf(sampler, key, kRepeat);
  return mode == kClampToEdge ? Wrap::kClamp : mode == kMirroredRepeat ? Wrap::kMirror : Wrap::kRepeat;
}

/// Rotation is counter-clockwise as seen, v running downwards: such that the first example of the extension's
/// text shows the lower left quarter that it speaks of.
CoordinateRecipe recipeOf(const json& use) {
  CoordinateRecipe recipe;
  std::size_t set = indexOf(use, "texCoord", 0);
  const json& transform = extension(use, "KHR_texture_transform");
  set = indexOf(transform, "texCoord", set);
  recipe.set = static_cast<int>(std::min<std::size_t>(set, std::numeric_limits<int>::max()));
  const auto pair = [&](const char* key, float usual) {
    const std::array<float, 2> value = transform.value(key, std::array<float, 2>{usual, usual});
    return Eigen::Vector2f(value[0], value[1]);
  };
  const float turn = transform.value("rotation", 0.0f);
  Eigen::Matrix2f rotation;
  rotation << std::cos(turn), std::sin(turn), -std::sin(turn), std::cos(turn);
  recipe.linear = rotation * pair("scale", 1.0f).asDiagonal();
  recipe.offset = pair("offset", 0.0f);
  return recipe;
}

/// Makes a look of one material of the file.
class LookReader {
 public:
  LookReader(const json& root, const json& source, const GltfMaterials::Picture& picture)
      : root_(root), source_(source), picture_(picture) {}

  GltfLook read() {
    Material& material = look_.material;
    material.name = source_.value("name", "");
    material.double_sided = source_.value("doubleSided", false);
    readMetallicRoughness();
    readDielectric();
    const json& older = extension(source_, "KHR_materials_pbrSpecularGlossiness");
    if (!older.empty()) readSpecularGlossiness(older);
    readEmission();
    readNormalAndOcclusion();
    readAlpha();
    readThrough();
    if (has(child(source_, "extensions"), "KHR_materials_unlit")) {
      lost_.push_back("unlit: lit as matt paint");
      material.roughness = 1.0f;
      material.metalness = 0.0f;
      material.roughness_map = material.metalness_map = TextureUse();
      material.dielectric = LinearRgb(0.0f, 0.0f, 0.0f);
      material.dielectric_grazing = 0.0f;
    }
    nameTheRest();
    return std::move(look_);
  }
  /// What cannot be shown, and what is made of it.
  const std::vector<std::string>& lost() const { return lost_; }

 private:
  /// Index of the coordinates that the texture `use` wants.
  int coordinatesOf(const json& use) {
    const CoordinateRecipe recipe = recipeOf(use);
    const auto same = std::find(look_.coordinates.begin(), look_.coordinates.end(), recipe);
    const auto index = static_cast<int>(same - look_.coordinates.begin());
    if (same == look_.coordinates.end()) look_.coordinates.push_back(recipe);
    return index;
  }

  TextureUse use(const json& of, const char* key, GltfMaterials::Slot slot, int channel) {
    if (!has(of, key)) return {};
    const json& info = child(of, key);
    const int texture = picture_(slot, wrapsOf(info));
    if (texture == TextureUse::kNone) return {};
    return {texture, coordinatesOf(info), channel};
  }

  Wraps wrapsOf(const json& info) const {
    const json& texture = child(root_, "textures").at(indexOf(info, "index", 0));
    if (!has(texture, "sampler")) return {};
    const json& sampler = child(root_, "samplers").at(indexOf(texture.at("sampler")));
    return {wrapOf(sampler, "wrapS"), wrapOf(sampler, "wrapT")};
  }

  bool repeats(const json& info) const {
    const Wraps wraps = wrapsOf(info);
    return wraps.u == Wrap::kRepeat && wraps.v == Wrap::kRepeat;
  }

  void readMetallicRoughness() {
    Material& material = look_.material;
    const json& pbr = child(source_, "pbrMetallicRoughness");
    material.base_color = clamped(color(pbr, "baseColorFactor", LinearRgb(1.0f, 1.0f, 1.0f)));
    material.roughness = within(pbr.value("roughnessFactor", 1.0f), Material::kSmoothest, 1.0f);
    material.metalness = within(pbr.value("metallicFactor", 1.0f), 0.0f, 1.0f);
    material.base_texture = use(pbr, "baseColorTexture", GltfMaterials::Slot::kBase, 0).texture;
    if (look_.coordinates.empty()) look_.coordinates.emplace_back();  // the first set is that of the colour
    if (has(pbr, "baseColorTexture") && material.base_texture == Material::kNoTexture)
      material.base_color = kNeutral;
    const auto slot = GltfMaterials::Slot::kMetallicRoughness;
    material.roughness_map = use(pbr, "metallicRoughnessTexture", slot, 1);
    material.metalness_map = material.roughness_map;
    if (material.metalness_map.given()) material.metalness_map.channel = 2;
    // Without its picture, a factor of 1 is no word about the metal.
    if (has(pbr, "metallicRoughnessTexture") && !material.metalness_map.given()) material.metalness = 0.0f;
  }

  /// The older workflow: what is specular is the reflectance of a dielectric.
  void readSpecularGlossiness(const json& older) {
    Material& material = look_.material;
    lost_.push_back("specular and glossiness: by their factors and the texture of the diffuse colour");
    look_.coordinates.clear();
    material.base_color = clamped(color(older, "diffuseFactor", LinearRgb(1.0f, 1.0f, 1.0f)));
    material.base_texture = use(older, "diffuseTexture", GltfMaterials::Slot::kDiffuse, 0).texture;
    if (look_.coordinates.empty()) look_.coordinates.emplace_back();
    material.roughness_map = material.metalness_map = TextureUse();
    material.roughness = within(1.0f - older.value("glossinessFactor", 1.0f), Material::kSmoothest, 1.0f);
    material.metalness = 0.0f;
    material.dielectric = clamped(color(older, "specularFactor", LinearRgb(1.0f, 1.0f, 1.0f)));
  }

  void readEmission() {
    Material& material = look_.material;
    const float strength =
        extension(source_, "KHR_materials_emissive_strength").value("emissiveStrength", 1.0f);
    material.emission = color(source_, "emissiveFactor", LinearRgb());
    material.emission.value = material.emission.value.max(0.0f) * std::max(strength, 0.0f);
    if (!material.emission.value.allFinite()) material.emission = LinearRgb();
    if (!(material.emission.value.maxCoeff() > 0.0f)) return;
    material.emission_map = use(source_, "emissiveTexture", GltfMaterials::Slot::kEmissive, 0);
    // What shines by a picture is not to shine all over without it.
    if (has(source_, "emissiveTexture") && !material.emission_map.given()) material.emission = LinearRgb();
  }

  void readNormalAndOcclusion() {
    Material& material = look_.material;
    material.normal_map = use(source_, "normalTexture", GltfMaterials::Slot::kNormal, 0);
    material.normal_scale = within(child(source_, "normalTexture").value("scale", 1.0f), -8.0f, 8.0f);
    material.occlusion_map = use(source_, "occlusionTexture", GltfMaterials::Slot::kOcclusion, 0);
    material.occlusion_strength =
        within(child(source_, "occlusionTexture").value("strength", 1.0f), 0.0f, 1.0f);
  }

  /// KHR_materials_ior and KHR_materials_specular: F0 = ((ior − 1) / (ior + 1))² · colour, at most 1, and all
  /// of Fresnel times the factor.
  void readDielectric() {
    Material& material = look_.material;
    const float index = extension(source_, "KHR_materials_ior").value("ior", 1.5f);
    const json& specular = extension(source_, "KHR_materials_specular");
    if (index == 1.5f && specular.empty()) return;
    const float weight = within(specular.value("specularFactor", 1.0f), 0.0f, 1.0f);
    const float root = index > 0.0f ? (index - 1.0f) / (index + 1.0f) : 1.0f;  // 0 stands for infinity
    const LinearRgb tint = color(specular, "specularColorFactor", LinearRgb(1.0f, 1.0f, 1.0f));
    material.dielectric.value = weight * (root * root * tint.value).max(0.0f).min(1.0f);
    material.dielectric_grazing = weight;
    if (has(specular, "specularTexture") || has(specular, "specularColorTexture"))
      lost_.push_back("a texture of its specular reflection: its factor counts alone");
  }

  /// Cutoff and mode as written; the factor is taken out of the cutoff, so that the texture alone is
  /// compared.
  void readAlpha() {
    Material& material = look_.material;
    const json& factor = child(child(source_, "pbrMetallicRoughness"), "baseColorFactor");
    const float alpha = factor.is_array() && factor.size() > 3 ? within(factor[3].get<float>(), 0, 1) : 1.0f;
    const std::string mode = source_.value("alphaMode", "OPAQUE");
    if (mode == "MASK") {
      const float cutoff = std::max(source_.value("alphaCutoff", 0.5f), 0.0f);
      material.alpha_mode = AlphaMode::kMask;
      look_.vanishes = cutoff > alpha;
      if (material.base_texture == Material::kNoTexture)
        material.alpha_mode = AlphaMode::kOpaque;
      else if (!repeats(child(child(source_, "pbrMetallicRoughness"), "baseColorTexture")))
        lost_.push_back("a wrap mode of a texture that cuts out: what is cut out repeats");
      material.alpha_cutoff = alpha > 0.0f ? within(cutoff / alpha, 0.0f, 1.0f) : 1.0f;
    } else if (mode == "BLEND") {
      material.alpha_mode = AlphaMode::kBlend;
      material.alpha = alpha;
      if (material.base_texture == Material::kNoTexture && alpha >= 1.0f)
        material.alpha_mode = AlphaMode::kOpaque;
      look_.vanishes = alpha <= 0.0f;
    }
  }

  /// What lets light through: thin sheets such as leaves, and glass.
  void readThrough() {
    Material& material = look_.material;
    const json& diffuse = extension(source_, "KHR_materials_diffuse_transmission");
    if (!diffuse.empty())
      material.transmission = within(diffuse.value("diffuseTransmissionFactor", 0.0f), 0.0f, 1.0f);
    if (has(diffuse, "diffuseTransmissionTexture") || has(diffuse, "diffuseTransmissionColorTexture"))
      lost_.push_back("a texture of its diffuse transmission: its factor counts alone");
    const json& glass = extension(source_, "KHR_materials_transmission");
    const float through = within(glass.value("transmissionFactor", 0.0f), 0.0f, 1.0f);
    if (!(through > 0.0f)) return;
    if (has(glass, "transmissionTexture"))
      lost_.push_back("a texture of its transmission: its factor counts alone");
    if (material.alpha_mode == AlphaMode::kOpaque) {
      material.glass = through;
      constexpr float kClear = 0.1f;  // of roughness: it blurs by less than a degree
      if (material.roughness > kClear)
        lost_.push_back("transmission of a rough surface: what lies behind is seen sharp");
      return;
    }
    if (!(through * (1.0f - material.metalness) > 0.0f)) return;
    lost_.push_back("transmission of what has an alpha: by a surface that covers the rest");
    if (material.alpha_mode != AlphaMode::kBlend) material.alpha = 1.0f;
    material.alpha_mode = AlphaMode::kBlend;
    material.alpha *= 1.0f - through * (1.0f - material.metalness);
    // So little of it is left that nothing but its reflection is seen.
    material.alpha = std::max(material.alpha, 0.1f);
  }

  void nameTheRest() {
    const json& extensions = child(source_, "extensions");
    const auto name = [&](const char* extension, const char* what) {
      if (has(extensions, extension)) lost_.push_back(what);
    };
    name("KHR_materials_clearcoat", "a clear coat: without it");
    name("KHR_materials_sheen", "sheen: without it");
    name("KHR_materials_volume", "a volume: as if it were hollow");
    name("KHR_materials_iridescence", "iridescence: without it");
    name("KHR_materials_anisotropy", "anisotropy: the same in all directions");
    name("KHR_materials_dispersion", "dispersion: without it");
  }

  const json& root_;
  const json& source_;
  const GltfMaterials::Picture& picture_;
  GltfLook look_;
  std::vector<std::string> lost_;
};

}  // namespace

struct GltfMaterials::Json {
  json root;
};

GltfMaterials::GltfMaterials(const std::string& file, SceneBuilder& builder)
    : file_(file), builder_(builder) {
  json root = parseGltf(gltfParts(file).json, file);
  requireGltf2(root, file);
  try {
    requireReadableGltf(root, file);
  } catch (const json::exception& error) {
    throw std::runtime_error(file + ": its accessors, meshes and skins: " + error.what());
  }
  json_ = std::make_unique<const Json>(Json{std::move(root)});
}

GltfMaterials::~GltfMaterials() = default;

std::optional<GltfLook> GltfMaterials::look(std::size_t index, const Picture& picture) const {
  const json& materials = child(json_->root, "materials");
  if (index >= materials.size()) return std::nullopt;
  try {
    LookReader reader(json_->root, materials.at(index), picture);
    GltfLook look = reader.read();
    for (const std::string& lost : reader.lost())
      builder_.warn(kNotRendered,
                    (look.material.name.empty() ? "material " + std::to_string(index) : look.material.name) +
                        " of " + file_ + ": " + lost);
    return look;
  } catch (const std::exception& error) {
    throw std::runtime_error(file_ + ": material " + std::to_string(index) + ": " + error.what());
  }
}

std::unique_ptr<GltfInput> GltfMaterials::input() const {
  try {
    return std::make_unique<GltfInput>(file_, json_->root);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(error.what() + whatItNeeds());
  }
}

void GltfMaterials::nameTheRest() const {
  for (const std::string& name : unknown("extensionsUsed"))
    builder_.warn("glTF extensions are not read", name + " of " + file_);
  for (const std::string& lost : shapesNotRead(json_->root, file_))
    builder_.warn("nodes have a shape that is not read whole", lost);
}

std::string GltfMaterials::whatItNeeds() const {
  std::string text;
  for (const std::string& name : unknown("extensionsRequired")) text += (text.empty() ? " " : ", ") + name;
  return text.empty() ? text : "; it needs" + text + ", not read here: export it without";
}

std::vector<std::string> GltfMaterials::unknown(const char* list) const {
  // Assimp reads the last one, or says that it was built without.
  static const std::set<std::string> known = {"KHR_texture_transform",   "EXT_texture_webp",
                                              "KHR_lights_punctual",     "KHR_mesh_quantization",
                                              "EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression"};
  std::vector<std::string> unknown;
  const json& used = child(json_->root, list);
  for (const json& name : used.is_array() ? used : json::array()) {
    const std::string text = name.is_string() ? name.get<std::string>() : name.dump();
    const bool of_materials = text.compare(0, 14, "KHR_materials_") == 0 && text != "KHR_materials_variants";
    const bool read = known.count(text) > 0 || (text == kPacked && unpacks());
    if (!of_materials && !read) unknown.push_back(text);
  }
  return unknown;
}

}  // namespace sunlit::scene
