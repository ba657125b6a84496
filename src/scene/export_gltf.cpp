#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>

#include "scene/export_json.h"
#include "scene/export_lamps.h"
#include "scene/export_losses.h"
#include "scene/export_maps.h"
#include "scene/glb_file.h"
#include "sunlit/image/files.h"
#include "sunlit/image/texture_files.h"
#include "sunlit/scene/export.h"

namespace sunlit::scene {
namespace {

// Names of numbers in glTF 2.0, section 3.6.2.2 and 5.25.
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;

class Writer {
 public:
  explicit Writer(const Scene& scene) : scene_(scene), maps_(scene) {}

  std::string glb() {
    for (const Material& material : scene_.materials) packed_.push_back(maps_.of(material, &losses_));
    addTextures();
    for (const Material& material : scene_.materials) addMaterial(material);
    for (const Mesh& mesh : scene_.meshes) addMesh(mesh);
    for (const Lamp& lamp : scene_.lamps) addLamp(lamp);
    std::vector<std::string> roots;
    for (std::size_t i = 0; i < nodes_.size(); ++i) roots.push_back(std::to_string(i));
    std::string text = "{\"asset\":{\"version\":\"2.0\",\"generator\":\"sunlit\"}";
    std::vector<std::string> used;
    if (!lights_.empty()) used.push_back("\"KHR_lights_punctual\"");
    if (transmits_) used.push_back("\"KHR_materials_diffuse_transmission\"");
    if (emits_) used.push_back("\"KHR_materials_emissive_strength\"");
    if (specular_) {
      used.push_back("\"KHR_materials_ior\"");
      used.push_back("\"KHR_materials_specular\"");
    }
    if (glazed_) used.push_back("\"KHR_materials_transmission\"");
    append(text, "extensionsUsed", used);
    if (!lights_.empty())
      text += ",\"extensions\":{\"KHR_lights_punctual\":{\"lights\":" + jsonArray(lights_) + "}}";
    text += ",\"scene\":0,\"scenes\":[{\"nodes\":" + jsonArray(roots) + "}]";
    append(text, "nodes", nodes_);
    append(text, "meshes", meshes_);
    append(text, "materials", materials_);
    append(text, "samplers", samplers_);
    append(text, "textures", textures_);
    append(text, "images", images_);
    append(text, "accessors", accessors_);
    append(text, "bufferViews", buffer_.views());
    text += ",\"buffers\":[{\"byteLength\":" + std::to_string(buffer_.bytes().size()) + "}]}";
    return glbFile(text, buffer_);
  }

  /// What the file does not say.
  std::vector<std::string> lost() const { return losses_.lines(); }

 private:
  static void append(std::string& text, const char* key, const std::vector<std::string>& items) {
    if (!items.empty()) text += ",\"" + std::string(key) + "\":" + jsonArray(items);
  }

  void addTextures() {
    std::vector<const Texture*> all;
    for (const Texture& texture : scene_.textures) all.push_back(&texture);
    for (const Texture& texture : maps_.textures()) all.push_back(&texture);
    std::vector<std::string> pngs(all.size());
    tbb::parallel_for(std::size_t{0}, pngs.size(), [&](std::size_t i) {
      image::Rgba8Image picture;
      picture.width = all[i]->width;
      picture.height = all[i]->height;
      picture.data.assign(all[i]->rgba.begin(), all[i]->rgba.end());
      pngs[i] = image::encodePng(picture);
    });
    for (std::size_t i = 0; i < pngs.size(); ++i) {
      const std::size_t view = buffer_.add(pngs[i].data(), pngs[i].size());
      images_.push_back("{\"mimeType\":\"image/png\",\"name\":" + jsonString(all[i]->name) +
                        ",\"bufferView\":" + std::to_string(view) + "}");
      textures_.push_back("{\"source\":" + std::to_string(i) + samplerOf(*all[i]) + "}");
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
    std::string text = "{\"name\":" + jsonString(material.name) +
                       ",\"pbrMetallicRoughness\":{\"baseColorFactor\":" +
                       jsonArray({number(base[0]), number(base[1]), number(base[2]),
                                  number(material.alpha_mode == AlphaMode::kBlend ? material.alpha : 1.0f)}) +
                       ",\"metallicFactor\":" + number(material.metalness) +
                       ",\"roughnessFactor\":" + number(material.roughness);
    if (material.base_texture != Material::kNoTexture) {
      text += ",\"baseColorTexture\":{\"index\":" + std::to_string(material.base_texture) + "}";
    }
    text += mapJson("metallicRoughnessTexture", packed_[materials_.size()]);
    text += std::string("},\"doubleSided\":") + (material.double_sided ? "true" : "false");
    if (material.alpha_mode == AlphaMode::kMask) {
      text += ",\"alphaMode\":\"MASK\",\"alphaCutoff\":" + number(material.alpha_cutoff);
    }
    if (material.alpha_mode == AlphaMode::kBlend) text += ",\"alphaMode\":\"BLEND\"";
    text += mapJson("normalTexture", material.normal_map, ",\"scale\":" + number(material.normal_scale));
    const TextureUse& occlusion = material.occlusion_map;
    text += mapJson("occlusionTexture", occlusion.channel == 0 ? occlusion : TextureUse(),
                    ",\"strength\":" + number(material.occlusion_strength));
    text += mapJson("emissiveTexture", material.emission_map);
    const float strength = material.emission.value.maxCoeff();
    if (strength > 0.0f) {
      emits_ = true;
      text += ",\"emissiveFactor\":" + vector3(material.emission.value / strength);
    }
    text += extensionsJson(material, strength);
    noteLosses(material);
    glazed_ = glazed_ || material.glass > 0.0f;
    transmits_ = transmits_ || material.transmission > 0.0f;
    specular_ = specular_ || hasOwnDielectric(material);
    if (material.detail.contrast > 0.0f)
      text += ",\"extras\":{\"sunlit_detail\":" + detailJson(material.detail) + "}";
    materials_.push_back(text + "}");
  }

  static std::string mapJson(const char* key, const TextureUse& use, const std::string& more = "") {
    if (!use.given()) return "";
    return ",\"" + std::string(key) + "\":{\"index\":" + std::to_string(use.texture) +
           ",\"texCoord\":" + std::to_string(use.coordinates) + more + "}";
  }

  void noteLosses(const Material& material) {
    if (material.occlusion_map.given() && material.occlusion_map.channel != 0)
      losses_.add("materials keep occlusion in another channel than red, it is left out", material.name);
    if (!material.lamp_group.empty() && material.emission.value.maxCoeff() > 0.0f)
      losses_.add("materials glow with the lamps here, always there", material.name);
    if (material.detail.contrast > 0.0f)
      losses_.add("materials have fractal detail, which no other program knows", material.name);
  }

  void addLamp(const Lamp& lamp) {
    if (lamp.relative)
      throw std::invalid_argument("lamp " + lamp.name + ": its intensity has no unit, but must be in cd");
    nodes_.push_back(lampNodeJson(lamp, lights_.size()));
    lights_.push_back(lightJson(lamp, &losses_));
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
    std::string text;
    if (material.transmission > 0.0f) {
      // What comes out on the other side has the colour of the surface here.
      text += ",\"KHR_materials_diffuse_transmission\":{\"diffuseTransmissionFactor\":" +
              number(material.transmission) +
              ",\"diffuseTransmissionColorFactor\":" + vector3(material.base_color.value) +
              mapJson("diffuseTransmissionColorTexture", TextureUse{material.base_texture}) + "}";
    }
    if (material.glass > 0.0f) {
      text += ",\"KHR_materials_transmission\":{\"transmissionFactor\":" + number(material.glass) + "}";
    }
    if (emissive_strength > 0.0f) {
      text += ",\"KHR_materials_emissive_strength\":{\"emissiveStrength\":" + number(emissive_strength) + "}";
    }
    if (hasOwnDielectric(material)) text += dielectricJson(material);
    return text.empty() ? text : ",\"extensions\":{" + text.substr(1) + "}";
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
      bool cut = false;
      for (Eigen::Array3f& color : colors) {
        cut = cut || color.maxCoeff() > 1.0f;
        color = color.min(1.0f);  // glTF 2.0, section 3.7.2.1
      }
      if (cut) losses_.add("meshes have vertex colours above 1, they are cut off there", mesh.name);
      attributes += ",\"COLOR_0\":" + addAccessor(colors, "VEC3");
    }
    const std::string name = jsonString(mesh.name);
    nodes_.push_back("{\"name\":" + name + ",\"mesh\":" + std::to_string(meshes_.size()) + "}");
    meshes_.push_back("{\"name\":" + name + ",\"primitives\":[{\"attributes\":{" + attributes +
                      "},\"indices\":" + addAccessor(mesh.triangles, "SCALAR") +
                      ",\"material\":" + std::to_string(mesh.material) + "}]}");
  }

  const Scene& scene_;
  ExportLosses losses_;
  PackedMaps maps_;
  std::vector<TextureUse> packed_;  ///< roughness and metalness of each material
  GlbBuffer buffer_;
  std::vector<std::string> nodes_, meshes_, materials_, samplers_, textures_, images_, accessors_, lights_;
  bool emits_ = false;
  bool glazed_ = false;
  bool transmits_ = false;
  bool specular_ = false;
};

static_assert(sizeof(Eigen::Vector3f) == 12 && sizeof(Eigen::Array3f) == 12 && sizeof(Eigen::Vector2f) == 8,
              "glTF wants tightly packed floats");

}  // namespace

std::vector<std::string> writeGltf(const Scene& scene, const std::string& file) {
  validate(scene);
  Writer writer(scene);
  std::string glb;
  try {
    glb = writer.glb();
  } catch (const std::length_error& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
  image::writeFileAtomically(file, glb);
  return writer.lost();
}

}  // namespace sunlit::scene
