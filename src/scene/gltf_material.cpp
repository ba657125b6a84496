#include "scene/gltf_material.h"

#include <set>
#include <stdexcept>
#include <utility>

#include "scene/gltf_check.h"
#include "scene/gltf_input.h"
#include "scene/gltf_json.h"
#include "scene/gltf_lights.h"
#include "scene/gltf_look.h"
#include "scene/gltf_mend.h"
#include "scene/gltf_order.h"
#include "scene/gltf_rest.h"
#include "scene/gltf_unpack.h"
#include "scene/mesh_file.h"
#include "sunlit/image/files.h"

namespace sunlit::scene {

using nlohmann::json;

struct GltfMaterials::Json {
  json root;
  bool mended;  ///< is no longer what the file says
};

namespace {

constexpr const char* kTurns =
    "glTF files turn nodes by quaternions that are not of length 1, which they are made";

/// Assimp tells the two kinds by their names.
void requireName(const GltfParts& parts, const std::string& file) {
  const bool named_binary = extensionOf(file) == ".glb";
  if (parts.binary && !named_binary)
    throw std::runtime_error(file + ": this is a binary glTF file, whose name must end in .glb");
  if (!parts.binary && named_binary)
    throw std::runtime_error(
        file +
        ": this is no binary glTF file, as one is whose name ends in .glb; if it is JSON, "
        "its name must end in .gltf");
}

}  // namespace

GltfMaterials::GltfMaterials(const std::string& file, SceneBuilder& builder)
    : file_(file), builder_(builder) {
  const GltfParts parts = gltfParts(file);
  requireName(parts, file);
  json root = parseGltf(parts.json, file);
  requireGltf2(root, file);
  const GltfMends mends = mendGltf(root);
  if (mends.scene) builder_.warn("glTF files have no scene, all that is in them is shown", file);
  if (mends.turns > 0) builder_.warn(kTurns, std::to_string(mends.turns) + " in " + file);
  if (mends.primitives > 0)
    builder_.warn("glTF files have parts of meshes with no or too few corners, which are left out",
                  std::to_string(mends.primitives) + " in " + file);
  try {
    requireReadableGltf(root, file);
  } catch (const json::exception& error) {
    throw std::runtime_error(file + ": its accessors, meshes and skins: " + error.what());
  }
  json_ = std::make_unique<const Json>(Json{std::move(root), mends.any() || parts.marked});
}

GltfMaterials::~GltfMaterials() = default;

std::optional<GltfLook> GltfMaterials::look(std::size_t index, const Picture& picture) const {
  const json& materials = child(json_->root, "materials");
  if (index >= materials.size()) return std::nullopt;
  try {
    std::vector<std::string> all_lost;
    GltfLook look = gltfLook(json_->root, materials.at(index), picture, &all_lost);
    for (const std::string& lost : all_lost)
      builder_.warn(kNotRendered, nameOf(index) + " of " + file_ + ": " + lost);
    return look;
  } catch (const std::exception& error) {
    throw std::runtime_error(file_ + ": material " + std::to_string(index) + ": " + error.what());
  }
}

std::string GltfMaterials::nameOf(std::size_t index) const {
  const json& name = child(child(json_->root, "materials").at(index), "name");
  return name.is_string() && name != "" ? name.get<std::string>() : "material " + std::to_string(index);
}

std::unique_ptr<GltfInput> GltfMaterials::input() const {
  try {
    auto input = std::make_unique<GltfInput>(file_, json_->root, json_->mended);
    if (input->turnedOfInstances() > 0)
      builder_.warn(kTurns, std::to_string(input->turnedOfInstances()) + " instances in " + file_);
    return input;
  } catch (const image::ContentMissing&) {
    throw;  // whatever the file needs besides
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(error.what() + whatItNeeds());
  }
}

std::vector<std::size_t> GltfMaterials::order(const std::vector<std::string>& names) const {
  return materialsInFile(json_->root, file_, names);
}

void GltfMaterials::addLights(const Eigen::Affine3d& up_from_file) const {
  addGltfLights(json_->root, file_, up_from_file, builder_);
}

void GltfMaterials::nameTheRest(std::uint64_t triangles) const {
  std::set<std::string> of_materials;  // which are named with these, where they are used
  for (const json& material : child(json_->root, "materials")) {
    for (const auto& extension : child(material, "extensions").items()) of_materials.insert(extension.key());
  }
  for (const std::string& name : unknown("extensionsUsed")) {
    if (of_materials.count(name) == 0) builder_.warn("glTF extensions are not read", name + " of " + file_);
  }
  for (const std::string& lost : shapesNotRead(json_->root, file_))
    builder_.warn("nodes have a shape that is not read whole", lost);
  try {
    for (const std::string& lost : scenesNotShown(json_->root, file_))
      builder_.warn(
          "scenes were left out, of several in a glTF file the one that it names is shown, or the first",
          lost);
    const std::uint64_t told = trianglesOfScene(json_->root);
    if (told > triangles)
      builder_.warn("files have triangles of vertices that are not there, they are left out",
                    std::to_string(told - triangles) + " in " + file_ +
                        (usesDraco(json_->root) ? ", whose Draco data have other counts than it tells" : ""));
  } catch (const std::exception& error) {
    throw std::runtime_error(file_ + ": its scene, nodes and meshes: " + error.what());
  }
}

std::string GltfMaterials::whatItNeeds() const {
  std::string text;
  for (const std::string& name : unknown("extensionsRequired")) text += (text.empty() ? " " : ", ") + name;
  return text.empty() ? text : "; it needs" + text + ", not read here: export it without";
}

std::vector<std::string> GltfMaterials::unknown(const char* list) const {
  // Assimp reads the last one, or says that it was built without.
  static const std::set<std::string> known = {"KHR_texture_transform", "KHR_lights_punctual",
                                              "KHR_mesh_quantization", "EXT_mesh_gpu_instancing", kDraco};
  std::vector<std::string> unknown;
  const json& used = child(json_->root, list);
  for (const json& name : used.is_array() ? used : json::array()) {
    const std::string text = name.is_string() ? name.get<std::string>() : name.dump();
    // Of pictures that are not read each is named.
    const bool read = known.count(text) > 0 || isOfPictures(text) || (isPacking(text) && unpacks());
    if (!isKnownOfMaterials(text) && !read) unknown.push_back(text);
  }
  return unknown;
}

}  // namespace sunlit::scene
