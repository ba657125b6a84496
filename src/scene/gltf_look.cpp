#include "scene/gltf_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "scene/clear_coat.h"
#include "scene/color.h"
#include "scene/gltf_json.h"

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

/// Whether two uses of textures, or of none, mean the same.
bool sameTexture(const json& a, const json& b) {
  return child(a, "index") == child(b, "index") && recipeOf(a) == recipeOf(b);
}

/// Makes a look of one material of the file.
class LookReader {
 public:
  LookReader(const json& root, const json& source, const GltfMaterials::Picture& picture,
             std::vector<std::string>* lost)
      : root_(root), source_(source), picture_(picture), lost_(*lost) {}

  GltfLook read() {
    Material& material = look_.material;
    material.name = source_.value("name", "");
    material.double_sided = source_.value("doubleSided", false);
    readMetallicRoughness();
    readDielectric();
    if (isOlder()) readSpecularGlossiness(extension(source_, kOlder));
    readEmission();
    readNormalAndOcclusion();
    readAlpha();
    readThrough();
    readClearCoat();
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

 private:
  static constexpr const char* kOlder = "KHR_materials_pbrSpecularGlossiness";
  bool isOlder() const { return has(child(source_, "extensions"), kOlder); }
  /// Of red, green, blue and alpha, and what it multiplies.
  const json& colorFactor() const {
    return isOlder() ? child(extension(source_, kOlder), "diffuseFactor")
                     : child(child(source_, "pbrMetallicRoughness"), "baseColorFactor");
  }
  const json& colorTexture() const {
    return isOlder() ? child(extension(source_, kOlder), "diffuseTexture")
                     : child(child(source_, "pbrMetallicRoughness"), "baseColorTexture");
  }

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
    constexpr std::size_t kNearest = 9728;
    return {wrapOf(sampler, "wrapS"), wrapOf(sampler, "wrapT"), indexOf(sampler, "magFilter", 0) == kNearest};
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
    const bool textured = has(older, "specularGlossinessTexture");
    lost_.push_back(
        std::string("specular and glossiness: by their factors and the texture of the diffuse colour") +
        (textured ? ", as if their own texture were 0.04 and one half" : ""));
    look_.coordinates.clear();
    material.base_color = clamped(color(older, "diffuseFactor", LinearRgb(1.0f, 1.0f, 1.0f)));
    material.base_texture = use(older, "diffuseTexture", GltfMaterials::Slot::kDiffuse, 0).texture;
    if (look_.coordinates.empty()) look_.coordinates.emplace_back();
    material.roughness_map = material.metalness_map = TextureUse();
    const float glossiness = older.value("glossinessFactor", 1.0f) * (textured ? 0.5f : 1.0f);
    material.roughness = within(1.0f - glossiness, Material::kSmoothest, 1.0f);
    material.metalness = 0.0f;
    material.dielectric = clamped(color(older, "specularFactor", LinearRgb(1.0f, 1.0f, 1.0f)));
    // Factors of 1 beside a texture say nothing of what is mirrored: all would be.
    if (textured) material.dielectric.value *= 0.04f;
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
    const json& factor = colorFactor();
    const float alpha = factor.is_array() && factor.size() > 3 ? within(factor[3].get<float>(), 0, 1) : 1.0f;
    const std::string mode = source_.value("alphaMode", "OPAQUE");
    look_.fades = mode != "OPAQUE";
    if (mode == "MASK") {
      const float cutoff = std::max(source_.value("alphaCutoff", 0.5f), 0.0f);
      material.alpha_mode = AlphaMode::kMask;
      look_.vanishes = cutoff > alpha;
      if (material.base_texture == Material::kNoTexture)
        material.alpha_mode = AlphaMode::kOpaque;
      else if (!repeats(colorTexture()))
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
    readDiffuseTransmission();
    const json& glass = extension(source_, "KHR_materials_transmission");
    const float through = within(glass.value("transmissionFactor", 0.0f), 0.0f, 1.0f);
    Material& material = look_.material;
    if (!(through > 0.0f)) return;
    if (has(glass, "transmissionTexture"))
      lost_.push_back("a texture of its transmission: its factor counts alone");
    if (material.alpha_mode == AlphaMode::kOpaque) {
      material.glass = through;
      keepOneOfBoth();
      if (material.glass > 0.0f) readGlass();
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

  void readDiffuseTransmission() {
    const json& diffuse = extension(source_, "KHR_materials_diffuse_transmission");
    Material& material = look_.material;
    material.transmission = within(diffuse.value("diffuseTransmissionFactor", 0.0f), 0.0f, 1.0f);
    if (!(material.transmission > 0.0f)) return;
    if (has(diffuse, "diffuseTransmissionTexture"))
      lost_.push_back("a texture of its diffuse transmission: its factor counts alone");
    const LinearRgb white(1.0f, 1.0f, 1.0f), tint = color(diffuse, "diffuseTransmissionColorFactor", white);
    const bool as_surface = (tint.value - material.base_color.value).abs().maxCoeff() < 1e-3f &&
                            sameTexture(child(diffuse, "diffuseTransmissionColorTexture"), colorTexture());
    if (!as_surface) lost_.push_back("a colour of its diffuse transmission: that of its surface counts");
  }

  /// Transmission comes before diffuse transmission, which has a share of what that leaves: each as its
  /// extension says. A surface here has but one of them.
  void keepOneOfBoth() {
    Material& material = look_.material;
    if (!(material.transmission > 0.0f)) return;
    const bool clear = material.glass >= (1.0f - material.glass) * material.transmission;
    lost_.push_back(clear ? "diffuse transmission beside transmission: without it"
                          : "transmission beside diffuse transmission, which is more: without it");
    (clear ? material.transmission : material.glass) = 0.0f;
  }

  void readGlass() {
    Material& material = look_.material;
    constexpr float kClear = 0.1f;  // of roughness: it blurs by less than a degree
    if (material.roughness > kClear)
      lost_.push_back("transmission of a rough surface: what lies behind is seen sharp");
    const json& volume = extension(source_, "KHR_materials_volume");
    const float thickness = volume.value("thicknessFactor", 0.0f);
    const float distance = volume.value("attenuationDistance", std::numeric_limits<float>::infinity());
    if (!(thickness > 0.0f)) return;
    material.double_sided = true;  // a hollow body has two walls, for eyes as for light
    if (!(distance > 0.0f) || !std::isfinite(thickness / distance)) return;
    // Beer and Lambert: its colour is what is left after that distance.
    const float depth = 0.5f * thickness / distance;
    const LinearRgb left = clamped(color(volume, "attenuationColor", LinearRgb(1.0f, 1.0f, 1.0f)));
    material.base_color.value *= left.value.pow(depth);
  }

  void readClearCoat() {
    const json& coat = extension(source_, "KHR_materials_clearcoat");
    const float factor = coat.value("clearcoatFactor", 0.0f);
    if (!(factor > 0.0f)) return;
    if (!addClearCoat({factor, coat.value("clearcoatRoughnessFactor", 0.0f)}, &look_.material)) {
      lost_.push_back(kLostCoat);
      return;
    }
    if (has(coat, "clearcoatTexture") || has(coat, "clearcoatRoughnessTexture"))
      lost_.push_back("a texture of its clear coat: its factors count alone");
    if (!sameTexture(child(coat, "clearcoatNormalTexture"), child(source_, "normalTexture")))
      lost_.push_back("normals of its clear coat: those of what it covers");
  }

  void nameTheRest() {
    const json& extensions = child(source_, "extensions");
    // Where it is 0, which it is unless told, the extension changes nothing.
    const auto name = [&](const char* extension, const char* strength, const char* what) {
      const json& told = child(child(extensions, extension), strength);  // a number, or those of a colour
      if (std::any_of(told.begin(), told.end(),
                      [](const json& one) { return one.is_number() && one.get<float>() > 0.0f; }))
        lost_.push_back(what);
    };
    name("KHR_materials_sheen", "sheenColorFactor", "sheen: without it");
    name("KHR_materials_volume", "thicknessFactor",
         look_.material.glass > 0.0f ? "a volume: as if it were hollow, its surface coloured as its depth"
                                     : "a volume: as if it were hollow");
    name("KHR_materials_iridescence", "iridescenceFactor", "iridescence: without it");
    name("KHR_materials_anisotropy", "anisotropyStrength", "anisotropy: the same in all directions");
    name("KHR_materials_dispersion", "dispersion", "dispersion: without it");
    for (const auto& [extension, content] : extensions.items()) {
      if (!isKnownOfMaterials(extension)) lost_.push_back(extension + ": without it");
    }
  }

  const json& root_;
  const json& source_;
  const GltfMaterials::Picture& picture_;
  GltfLook look_;
  std::vector<std::string>& lost_;
};

}  // namespace

bool isKnownOfMaterials(const std::string& extension) {
  static const std::set<std::string> known = {"KHR_materials_anisotropy",
                                              "KHR_materials_clearcoat",
                                              "KHR_materials_diffuse_transmission",
                                              "KHR_materials_dispersion",
                                              "KHR_materials_emissive_strength",
                                              "KHR_materials_ior",
                                              "KHR_materials_iridescence",
                                              "KHR_materials_pbrSpecularGlossiness",
                                              "KHR_materials_sheen",
                                              "KHR_materials_specular",
                                              "KHR_materials_transmission",
                                              "KHR_materials_unlit",
                                              "KHR_materials_volume"};
  return known.count(extension) > 0;
}

GltfLook gltfLook(const json& root, const json& source, const GltfMaterials::Picture& picture,
                  std::vector<std::string>* lost) {
  return LookReader(root, source, picture, lost).read();
}

}  // namespace sunlit::scene
