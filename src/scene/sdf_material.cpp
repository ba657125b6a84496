#include "scene/sdf_material.h"

#include <algorithm>
#include <sdf/Pbr.hh>

#include "scene/color.h"
#include "scene/gazebo_material.h"
#include "scene/sdf_library.h"

namespace sunlit::scene {
namespace {

LinearRgb toLinear(const ignition::math::Color& color) {
  return linearFromSrgb({color.R(), color.G(), color.B()});
}

bool isPlain(const sdf::Material& source) {
  return source.Element()->HasElement("diffuse") || source.Element()->HasElement("ambient");
}

bool isScripted(const sdf::Material& source) {
  return !source.ScriptName().empty() && source.Element()->HasElement("script");
}

/// Times that of its texture.
void setOpacity(float opacity, Material* material) {
  material->alpha_mode = AlphaMode::kBlend;
  material->alpha = opacity;
}

}  // namespace

int SdfMaterials::texture(const std::string& name, const std::string& from_file) {
  Found found = finder_.findTexture(name, from_file);
  if (!found.file) found = finder_.find(name, from_file);
  if (!found.file) {
    builder_.warn(kMissingTextures, name + " of " + from_file);
    return Material::kNoTexture;
  }
  return builder_.textureFromFile(*found.file);
}

SdfMaterials::Scripted SdfMaterials::fromScript(const sdf::Material& source) {
  if (const std::optional<GazeboLook> look = gazeboLook(source.ScriptName())) {
    if (look->pictured) builder_.warn(kPicturesOfGazebo, source.ScriptName());
    return {materialOf(*look, source.ScriptName())};
  }
  // <script> may hold several <uri>; sdf::Material keeps the first only.
  ScriptUse use{source.ScriptName(), {}, source.FilePath()};
  const sdf::ElementPtr script = source.Element() ? firstIn(*source.Element(), "script") : nullptr;
  for (sdf::ElementPtr uri = script ? firstIn(*script, "uri") : nullptr; uri;
       uri = uri->GetNextElement("uri"))
    use.uris.push_back(uri->Get<std::string>());
  if (const std::optional<ScriptMaterial> found = scripts_.find(use))
    return {lookOf(*found, use), found->texture_scale.value_or(Eigen::Array2f::Ones())};
  builder_.warn("material scripts are not known, a neutral material takes their place", use.name);
  Material neutral;
  neutral.name = use.name;
  neutral.base_color = kNeutral;
  return {neutral};
}

Material SdfMaterials::lookOf(const ScriptMaterial& script, const ScriptUse& use) {
  Material material;
  material.name = use.name;
  material.base_color = kNeutral;
  if (script.texture) {
    const std::optional<std::string> file = scripts_.texture(script, use);
    if (file) material.base_texture = builder_.textureFromFile(*file);
    if (!file) builder_.warn(kMissingTextures, *script.texture + " of " + script.texture_from);
  }
  const bool textured = material.base_texture != Material::kNoTexture;
  const LinearRgb white(1.0f, 1.0f, 1.0f);
  const LinearRgb tint = script.tints ? script.diffuse.value_or(white) : white;
  if (textured) material.base_color = factorBesidePicture(tint);
  if (script.diffuse && !script.texture) material.base_color = *script.diffuse;
  if (script.emissive) material.emission.value = kDisplayWhite_cd_per_m2 * script.emissive->value;
  for (const std::string& lost : script.lost)
    builder_.warn(kNotRendered, "script " + material.name + ": " + lost + ": without it");
  if (script.blends) setOpacity(script.opacity, &material);
  if (script.alpha_rejection && textured) material.alpha_mode = AlphaMode::kMask;
  return material;
}

void SdfMaterials::readPbr(const sdf::Material& source, Material& material) {
  const sdf::PbrWorkflow* metal = source.PbrMaterial()->Workflow(sdf::PbrWorkflowType::METAL);
  if (metal == nullptr) {
    builder_.warn("PBR materials are not of the metal workflow, their diffuse colour is used alone",
                  material.name);
    return;
  }
  material.roughness = std::clamp(static_cast<float>(metal->Roughness()), Material::kSmoothest, 1.0f);
  material.metalness = std::clamp(static_cast<float>(metal->Metalness()), 0.0f, 1.0f);
  if (!metal->AlbedoMap().empty()) {
    material.base_texture = texture(metal->AlbedoMap(), source.FilePath());
    if (material.base_texture == Material::kNoTexture) material.base_color = kNeutral;
  }
  readMaps(*metal, source, material);
}

void SdfMaterials::readMaps(const sdf::PbrWorkflow& metal, const sdf::Material& source, Material& material) {
  const auto map = [&](const std::string& name) {
    return TextureUse{name.empty() ? TextureUse::kNone : texture(name, source.FilePath())};
  };
  const std::string name = "PBR material of " + source.FilePath() + ": ";
  // An attribute that not all versions of libsdformat have a word for.
  const sdf::ElementPtr normals = metal.Element() ? firstIn(*metal.Element(), "normal_map") : nullptr;
  if (normals && normals->Get<std::string>("type", "tangent").first == "object")
    builder_.warn(kNotRendered, name + "a normal map in the space of its object: without it");
  else
    material.normal_map = map(metal.NormalMap());
  material.occlusion_map = map(metal.AmbientOcclusionMap());
  // Grey pictures; a factor beside them would be the default that they stand in for.
  material.roughness_map = map(metal.RoughnessMap());
  if (material.roughness_map.given()) material.roughness = 1.0f;
  material.metalness_map = map(metal.MetalnessMap());
  if (material.metalness_map.given()) material.metalness = 1.0f;
  material.emission_map = map(metal.EmissiveMap());
  if (!metal.EmissiveMap().empty() && !material.emission_map.given())
    material.emission = LinearRgb();  // not all over
  else if (material.emission_map.given() && !source.Element()->HasElement("emissive"))
    material.emission.value.setConstant(kDisplayWhite_cd_per_m2);
  if (!metal.EnvironmentMap().empty())
    builder_.warn(kNotRendered, name + "an environment map: it mirrors what there is");
  if (!lightMapOf(metal).empty()) builder_.warn(kNotRendered, name + "a light map: light is computed");
}

/// As gz-sim has it. Files of Gazebo Classic, which never looks at it, often have a 0 there.
void SdfMaterials::readOpacity(float alpha, Material* material) {
  if (alpha >= 1.0f) return;
  if (alpha > 0.0f)
    setOpacity(alpha, material);
  else
    builder_.warn(kNotRendered,
                  "material " + material->name + ": <diffuse> of an alpha of 0: drawn as opaque");
}

void SdfMaterials::nameLost(const sdf::Material& source, const std::string& name) {
  const auto lost = [&](const std::string& what) {
    builder_.warn(kNotRendered, "material " + name + " of " + source.FilePath() + ": " + what);
  };
  if (source.Element()->HasElement("lighting") && !source.Lighting())
    lost("<lighting> false: lit like any other");
  if (!source.NormalMap().empty()) lost("the normal map of its <shader>: without it");
}

bool SdfMaterials::isLook(const sdf::Material* source) {
  if (source == nullptr || !source->Element()) return false;
  const bool glows =
      source->Element()->HasElement("emissive") && toLinear(source->Emissive()).value.maxCoeff() > 0.0f;
  return isPlain(*source) || isScripted(*source) || source->PbrMaterial() != nullptr || glows;
}

std::optional<int> SdfMaterials::add(const sdf::Material* source, const std::string& user) {
  if (!isLook(source)) return std::nullopt;
  const sdf::ElementPtr element = source->Element();
  const bool plain = isPlain(*source), scripted = isScripted(*source);
  const bool pbr = source->PbrMaterial() != nullptr;
  const std::string content = source->FilePath() + element->ToString("");
  const auto known = index_by_content_.find(content);
  if (known != index_by_content_.end()) return known->second;
  Material material;
  Eigen::Array2f texture_scale(1.0f, 1.0f);
  if (scripted && !pbr) {
    const Scripted script = fromScript(*source);
    material = script.material;
    texture_scale = script.texture_scale;
    // Gazebo applies the script, and then what stands beside it.
    if (element->HasElement("diffuse")) {
      if (material.base_texture == Material::kNoTexture)
        material.base_color = toLinear(source->Diffuse());
      else
        builder_.warn(kNotRendered,
                      "<diffuse> beside script " + material.name + ", which has a texture: without it");
    }
  } else {
    material.name = user;
    // Ambient alone is how some files give a colour; the light around is computed here, not given by the
    // material.
    material.base_color = toLinear(element->HasElement("diffuse") ? source->Diffuse() : source->Ambient());
    const ignition::math::Color specular = source->Specular();
    if (std::max({specular.R(), specular.G(), specular.B()}) > 0.3f) material.roughness = 0.5f;
  }
  if (element->HasElement("diffuse")) readOpacity(source->Diffuse().A(), &material);
  if (element->HasElement("emissive"))
    material.emission.value = kDisplayWhite_cd_per_m2 * toLinear(source->Emissive()).value;
  if (pbr) {
    if (!plain) material.base_color = LinearRgb(1.0f, 1.0f, 1.0f);
    readPbr(*source, material);
  }
  nameLost(*source, material.name);
  // A script says it where alpha is to be looked at: many a picture keeps other things in it, such as
  // heights.
  const AlphaRule alpha = scripted && !pbr ? AlphaRule::kDeclared : AlphaRule::kFromTexture;
  const int index = builder_.addMaterial(material, alpha);
  if ((texture_scale != 1.0f).any()) texture_scales_[index] = texture_scale;
  return index_by_content_[content] = index;
}

void SdfMaterials::put(int material, Mesh& mesh) const {
  mesh.material = material;
  const auto scale = texture_scales_.find(material);
  if (scale == texture_scales_.end()) return;
  for (Eigen::Vector2f& at : mesh.texture_coordinates)
    at = ((at.array() - 0.5f) / scale->second + 0.5f).matrix();
}

int SdfMaterials::neutral() {
  const auto known = index_by_content_.find("");
  if (known != index_by_content_.end()) return known->second;
  Material material;
  material.name = "neutral";
  material.base_color = kNeutral;
  return index_by_content_[""] = builder_.addMaterial(material, AlphaRule::kDeclared);
}

}  // namespace sunlit::scene
