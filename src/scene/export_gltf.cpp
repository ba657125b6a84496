#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "scene/glb_file.h"
#include "sunlit/image/files.h"
#include "sunlit/image/texture_files.h"
#include "sunlit/scene/export.h"

namespace sunlit::scene {
namespace {

// Names of numbers in glTF 2.0, section 3.6.2.2 and 5.25.
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;

/// Enough digits to give a float back unchanged.
std::string number(float value) {
  std::ostringstream text;
  text.precision(9);
  text << value;
  return text.str();
}

std::string vector3(const Eigen::Array3f& value) {
  return jsonArray({number(value[0]), number(value[1]), number(value[2])});
}

/// +Y up from z up.
Eigen::Vector3f yUp(const Eigen::Vector3f& map) {
  return {map.x(), map.z(), -map.y()};
}

class Writer {
 public:
  explicit Writer(const Scene& scene) : scene_(scene) {}

  std::string glb() {
    addTextures();
    for (const Material& material : scene_.materials) addMaterial(material);
    for (const Mesh& mesh : scene_.meshes) addMesh(mesh);
    std::vector<std::string> roots;
    for (std::size_t i = 0; i < nodes_.size(); ++i) roots.push_back(std::to_string(i));
    std::string json = "{\"asset\":{\"version\":\"2.0\",\"generator\":\"sunlit\"}";
    std::vector<std::string> used;
    if (transmits_) used.push_back("\"KHR_materials_diffuse_transmission\"");
    if (emits_) used.push_back("\"KHR_materials_emissive_strength\"");
    if (specular_) {
      used.push_back("\"KHR_materials_ior\"");
      used.push_back("\"KHR_materials_specular\"");
    }
    append(json, "extensionsUsed", used);
    json += ",\"scene\":0,\"scenes\":[{\"nodes\":" + jsonArray(roots) + "}]";
    append(json, "nodes", nodes_);
    append(json, "meshes", meshes_);
    append(json, "materials", materials_);
    append(json, "samplers", samplers_);
    append(json, "textures", textures_);
    append(json, "images", images_);
    append(json, "accessors", accessors_);
    append(json, "bufferViews", buffer_.views());
    json += ",\"buffers\":[{\"byteLength\":" + std::to_string(buffer_.bytes().size()) + "}]}";
    return glbFile(json, buffer_);
  }

 private:
  static void append(std::string& json, const char* key, const std::vector<std::string>& items) {
    if (!items.empty()) json += ",\"" + std::string(key) + "\":" + jsonArray(items);
  }

  void addTextures() {
    std::vector<std::string> pngs(scene_.textures.size());
    tbb::parallel_for(std::size_t{0}, pngs.size(), [&](std::size_t i) {
      image::Rgba8Image picture;
      picture.width = scene_.textures[i].width;
      picture.height = scene_.textures[i].height;
      picture.data = scene_.textures[i].rgba;
      pngs[i] = image::encodePng(picture);
    });
    for (std::size_t i = 0; i < pngs.size(); ++i) {
      const std::size_t view = buffer_.add(pngs[i].data(), pngs[i].size());
      images_.push_back("{\"mimeType\":\"image/png\",\"name\":" + jsonString(scene_.textures[i].name) +
                        ",\"bufferView\":" + std::to_string(view) + "}");
      textures_.push_back("{\"source\":" + std::to_string(i) + samplerOf(scene_.textures[i]) + "}");
    }
  }

  /// Part of a texture's entry; none where it repeats.
  std::string samplerOf(const Texture& texture) {
    if (texture.wrap_u == Wrap::kRepeat && texture.wrap_v == Wrap::kRepeat) return "";
    const auto mode = [](Wrap wrap) {  // glTF 2.0, section 5.26
      return wrap == Wrap::kClamp ? "33071" : wrap == Wrap::kMirror ? "33648" : "10497";
    };
    samplers_.push_back(std::string("{\"wrapS\":") + mode(texture.wrap_u) +
                        ",\"wrapT\":" + mode(texture.wrap_v) + "}");
    return ",\"sampler\":" + std::to_string(samplers_.size() - 1);
  }

  void addMaterial(const Material& material) {
    const Eigen::Array3f base = material.base_color.value;
    std::string json = "{\"name\":" + jsonString(material.name) +
                       ",\"pbrMetallicRoughness\":{\"baseColorFactor\":" +
                       jsonArray({number(base[0]), number(base[1]), number(base[2]),
                                  number(material.alpha_mode == AlphaMode::kBlend ? material.alpha : 1.0f)}) +
                       ",\"metallicFactor\":" + number(material.metalness) +
                       ",\"roughnessFactor\":" + number(material.roughness);
    if (material.base_texture != Material::kNoTexture) {
      json += ",\"baseColorTexture\":{\"index\":" + std::to_string(material.base_texture) + "}";
    }
    json += metallicRoughnessJson(material);
    json += std::string("},\"doubleSided\":") + (material.double_sided ? "true" : "false");
    if (material.alpha_mode == AlphaMode::kMask) {
      json += ",\"alphaMode\":\"MASK\",\"alphaCutoff\":" + number(material.alpha_cutoff);
    }
    if (material.alpha_mode == AlphaMode::kBlend) json += ",\"alphaMode\":\"BLEND\"";
    json += mapJson("normalTexture", material.normal_map, ",\"scale\":" + number(material.normal_scale));
    json += mapJson("occlusionTexture", material.occlusion_map,
                    ",\"strength\":" + number(material.occlusion_strength));
    json += mapJson("emissiveTexture", material.emission_map);
    const float strength = material.emission.value.maxCoeff();
    if (strength > 0.0f) {
      emits_ = true;
      json += ",\"emissiveFactor\":" + vector3(material.emission.value / strength);
    }
    json += extensionsJson(material, strength);
    transmits_ = transmits_ || material.transmission > 0.0f;
    specular_ = specular_ || hasOwnDielectric(material);
    if (material.detail.contrast > 0.0f)
      json += ",\"extras\":{\"sunlit_detail\":" + detailJson(material.detail) + "}";
    materials_.push_back(json + "}");
  }

  static std::string mapJson(const char* key, const TextureUse& use, const std::string& more = "") {
    if (!use.given()) return "";
    return ",\"" + std::string(key) + "\":{\"index\":" + std::to_string(use.texture) +
           ",\"texCoord\":" + std::to_string(use.coordinates) + more + "}";
  }

  /// glTF has both in one texture: roughness in green, metalness in blue.
  static std::string metallicRoughnessJson(const Material& material) {
    const TextureUse &rough = material.roughness_map, &metal = material.metalness_map;
    const bool as_gltf = rough.given() && metal.given() && rough.texture == metal.texture &&
                         rough.coordinates == metal.coordinates && rough.channel == 1 && metal.channel == 2;
    return as_gltf ? mapJson("metallicRoughnessTexture", rough) : "";
  }

  static bool hasOwnDielectric(const Material& material) {
    const Material usual;
    return (material.dielectric.value != usual.dielectric.value).any() || material.dielectric_grazing != 1.0f;
  }

  /// By KHR_materials_ior of a reflectance of 1, which the colour of KHR_materials_specular then scales.
  static std::string dielectricJson(const Material& material) {
    const float weight = material.dielectric_grazing;
    const Eigen::Array3f color = weight > 0.0f ? Eigen::Array3f(material.dielectric.value / weight)
                                               : Eigen::Array3f(Eigen::Array3f::Zero());
    return ",\"KHR_materials_ior\":{\"ior\":0},\"KHR_materials_specular\":{\"specularFactor\":" +
           number(weight) + ",\"specularColorFactor\":" + vector3(color) + "}";
  }

  static std::string extensionsJson(const Material& material, float emissive_strength) {
    std::string json;
    if (material.transmission > 0.0f) {
      json += ",\"KHR_materials_diffuse_transmission\":{\"diffuseTransmissionFactor\":" +
              number(material.transmission) +
              ",\"diffuseTransmissionColorFactor\":" + vector3(material.base_color.value) + "}";
    }
    if (emissive_strength > 0.0f) {
      json += ",\"KHR_materials_emissive_strength\":{\"emissiveStrength\":" + number(emissive_strength) + "}";
    }
    if (hasOwnDielectric(material)) json += dielectricJson(material);
    return json.empty() ? json : ",\"extensions\":{" + json.substr(1) + "}";
  }

  static std::string detailJson(const Detail& detail) {
    return "{\"contrast\":" + number(detail.contrast) + ",\"coarsest_m\":" + number(detail.coarsest_m) +
           ",\"finest_m\":" + number(detail.finest_m) + ",\"gain\":" + number(detail.gain) +
           ",\"tint\":" + vector3(detail.tint) + "}";
  }

  /// Index of an accessor over `data`; `more` is put into its entry.
  template <typename Value>
  std::string addAccessor(const std::vector<Value>& data, const std::string& type,
                          const std::string& more = "") {
    const std::size_t view = buffer_.add(data.data(), data.size() * sizeof(Value));
    const bool scalar = type == "SCALAR";
    const std::size_t count = scalar ? data.size() * sizeof(Value) / sizeof(std::uint32_t) : data.size();
    accessors_.push_back("{\"bufferView\":" + std::to_string(view) +
                         ",\"componentType\":" + std::to_string(scalar ? kUnsignedInt : kFloat) +
                         ",\"count\":" + std::to_string(count) + ",\"type\":\"" + type + "\"" + more + "}");
    return std::to_string(accessors_.size() - 1);
  }

  void addMesh(const Mesh& mesh) {
    if (mesh.triangles.empty()) return;
    std::vector<Eigen::Vector3f> positions(mesh.positions.size());
    std::vector<Eigen::Vector3f> normals(mesh.normals.size());
    std::transform(mesh.positions.begin(), mesh.positions.end(), positions.begin(), yUp);
    std::transform(mesh.normals.begin(), mesh.normals.end(), normals.begin(), yUp);
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& position : positions) box.extend(position);
    std::string attributes =
        "\"POSITION\":" +
        addAccessor(positions, "VEC3", ",\"min\":" + vector3(box.min()) + ",\"max\":" + vector3(box.max())) +
        ",\"NORMAL\":" + addAccessor(normals, "VEC3");
    if (!mesh.texture_coordinates.empty()) {
      attributes += ",\"TEXCOORD_0\":" + addAccessor(mesh.texture_coordinates, "VEC2");
    }
    for (std::size_t set = 0; set < mesh.more_texture_coordinates.size(); ++set) {
      const auto& coordinates = mesh.more_texture_coordinates[set];
      if (!coordinates.empty())
        attributes += ",\"TEXCOORD_" + std::to_string(set + 1) + "\":" + addAccessor(coordinates, "VEC2");
    }
    if (!mesh.tangents.empty()) {
      std::vector<Eigen::Vector4f> tangents = mesh.tangents;
      for (Eigen::Vector4f& tangent : tangents) tangent.head<3>() = yUp(tangent.head<3>());
      attributes += ",\"TANGENT\":" + addAccessor(tangents, "VEC4");
    }
    if (!mesh.colors.empty()) {
      std::vector<Eigen::Array3f> colors = mesh.colors;
      for (Eigen::Array3f& color : colors) color = color.min(1.0f);  // glTF 2.0, section 3.7.2.1
      attributes += ",\"COLOR_0\":" + addAccessor(colors, "VEC3");
    }
    const std::string name = jsonString(mesh.name);
    nodes_.push_back("{\"name\":" + name + ",\"mesh\":" + std::to_string(meshes_.size()) + "}");
    meshes_.push_back("{\"name\":" + name + ",\"primitives\":[{\"attributes\":{" + attributes +
                      "},\"indices\":" + addAccessor(mesh.triangles, "SCALAR") +
                      ",\"material\":" + std::to_string(mesh.material) + "}]}");
  }

  const Scene& scene_;
  GlbBuffer buffer_;
  std::vector<std::string> nodes_, meshes_, materials_, samplers_, textures_, images_, accessors_;
  bool emits_ = false;
  bool transmits_ = false;
  bool specular_ = false;
};

static_assert(sizeof(Eigen::Vector3f) == 12 && sizeof(Eigen::Array3f) == 12 && sizeof(Eigen::Vector2f) == 8,
              "glTF wants tightly packed floats");

}  // namespace

void writeGltf(const Scene& scene, const std::string& file) {
  validate(scene);
  std::string glb;
  try {
    glb = Writer(scene).glb();
  } catch (const std::length_error& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
  image::writeFileAtomically(file, glb);
}

}  // namespace sunlit::scene
