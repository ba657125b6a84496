#include "scene/gltf_input.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "scene/glb_file.h"
#include "scene/gltf_addresses.h"
#include "scene/gltf_buffers.h"
#include "scene/gltf_draco.h"
#include "scene/gltf_floats.h"
#include "scene/gltf_instances.h"
#include "scene/gltf_json.h"
#include "scene/gltf_mend.h"
#include "scene/gltf_numbers.h"
#include "scene/gltf_unpack.h"
#include "scene/memory_stream.h"
#include "sunlit/image/files.h"

namespace sunlit::scene {
namespace {

using nlohmann::json;

/// Extensions by which textures have pictures; that of the first is read.
constexpr const char* kOfPictures[] = {"EXT_texture_webp", "KHR_texture_basisu", "MSFT_texture_dds",
                                       "EXT_texture_avif"};

bool lacksMatrices(const json& skin) {
  return skin.is_object() && !skin.contains("inverseBindMatrices");
}

/// The number of joints of the largest skin without matrices, at least 1; 0 where there is no such skin.
std::size_t jointsWithoutMatrices(const json& root) {
  std::size_t most = 0;
  for (const json& skin : child(root, "skins")) {
    if (lacksMatrices(skin)) most = std::max({most, child(skin, "joints").size(), std::size_t{1}});
  }
  return most;
}

template <typename Value>
std::size_t append(json& root, const char* list, Value value) {
  root[list].push_back(std::move(value));
  return root[list].size() - 1;
}

std::string unitMatrices(std::size_t count) {
  std::vector<float> numbers;
  for (std::size_t i = 0; i < 16 * count; ++i) numbers.push_back(i % 16 % 5 == 0 ? 1.0f : 0.0f);
  return {reinterpret_cast<const char*>(numbers.data()), sizeof(float) * numbers.size()};
}

/// Gives skins without matrices unit ones. Whether there were any.
bool giveMatrices(json& root, GltfBuffers& buffers) {
  const std::size_t most = jointsWithoutMatrices(root);
  if (most == 0) return false;
  std::string matrices = unitMatrices(most);
  const std::size_t bytes = matrices.size(), buffer = buffers.add(std::move(matrices));
  const std::size_t view = append(root, "bufferViews", json{{"buffer", buffer}, {"byteLength", bytes}});
  for (json& skin : root["skins"]) {
    if (!lacksMatrices(skin)) continue;
    skin["inverseBindMatrices"] =
        append(root, "accessors",
               json{{"bufferView", view},
                    {"componentType", kFloatComponent},
                    {"count", std::max(child(skin, "joints").size(), std::size_t{1})},
                    {"type", "MAT4"}});
  }
  return true;
}

/// Below the size of `nodes`.
std::set<std::size_t> jointsOf(const json& root) {
  std::set<std::size_t> joints;
  for (const json& skin : child(root, "skins")) {
    for (const json& joint : child(skin, "joints")) {
      if (joint.is_number_unsigned() && joint.get<std::size_t>() < child(root, "nodes").size())
        joints.insert(joint.get<std::size_t>());
    }
  }
  return joints;
}

/// Gives joints that share their name with another node one of their own, by which Assimp tells them. Whether
/// there were any.
bool nameJoints(json& root) {
  const auto nameOf = [](const json& node) {
    const json& name = child(node, "name");
    return name.is_string() ? name.get<std::string>() : std::string();
  };
  std::map<std::string, std::size_t> times;
  for (const json& node : child(root, "nodes")) ++times[nameOf(node)];
  bool any = false;
  for (const std::size_t joint : jointsOf(root)) {
    std::string name = nameOf(root["nodes"][joint]);
    if (name.empty() || times[name] == 1) continue;  // Assimp names those without a name itself
    do name += "#" + std::to_string(joint);
    while (times.count(name) > 0);
    times[name] = 1;
    root["nodes"][joint]["name"] = name;
    any = true;
  }
  return any;
}

/// Gives textures that are WebP pictures these as their own, in the place of others for readers that have no
/// WebP; those of formats that are not read only where there is no other, so that these are named. Whether
/// there are any.
bool usePictures(json& root) {
  bool any = false;
  if (!child(root, "textures").is_array()) return any;
  for (json& texture : root["textures"]) {
    for (const char* const name : kOfPictures) {
      const json& picture = child(extension(texture, name), "source");
      const bool wanted = name == kOfPictures[0] || !texture.contains("source");
      if (!picture.is_number_unsigned() || !wanted) continue;
      texture["source"] = picture.get<std::size_t>();
      any = true;
      break;
    }
  }
  return any;
}

/// The bytes of `file` with another JSON.
std::string withJson(const std::string& file, std::string text) {
  const GltfParts old = gltfParts(file);
  return old.binary ? glbStart(std::move(text), old.rest.size()) + old.rest : text;
}

}  // namespace

bool isOfPictures(const std::string& extension) {
  return std::find(std::begin(kOfPictures), std::end(kOfPictures), extension) != std::end(kOfPictures);
}

void requireGltf2(const json& root, const std::string& file) {
  if (!root.contains("asset"))
    throw std::runtime_error(file + ": this is no glTF file: it has no \"asset\", which tells its version");
  const json& version = child(child(root, "asset"), "version");
  if (!version.is_string() && !version.is_number()) return;  // Assimp says what it misses
  const std::string text = version.is_string() ? version.get<std::string>() : version.dump();
  if (text.compare(0, 2, "2.") != 0 && text != "2")
    throw std::runtime_error(file + ": this is glTF " + (text.empty() ? "without a version" : text) +
                             ", and only 2.0 is read: convert it, by Blender or gltf-pipeline");
  const json& least = child(child(root, "asset"), "minVersion");
  const std::string needed = least.is_string() ? least.get<std::string>() : least.dump();
  if (std::strtod(needed.c_str(), nullptr) > 2.0)
    throw std::runtime_error(file + ": this file needs glTF " + needed +
                             ", as its minVersion says, and only 2.0 is read");
}

GltfInput::GltfInput(const std::string& file, json root, bool mended) : file_(file) {
  GltfBuffers buffers(root, file);
  mended |= usePlainAddresses(root);
  mended |= root.erase("animations") > 0;  // whose numbers Assimp would not check, for nothing
  try {
    buffers.requireContents();
    mended |= unpackViews(root, buffers);
    mended |= unpackDraco(root, buffers);
    mended |= placeInstances(root, buffers);
    turned_of_instances_ = makeUnit(root);  // those of nodes of the file are by now
    mended |= giveZeros(root, buffers);
    mended |= useFloats(root, buffers);
    mended |= giveMatrices(root, buffers);
    mended |= nameJoints(root);
  } catch (const json::exception& error) {
    throw std::runtime_error(file + ": an attribute is not as glTF has it: " + error.what());
  } catch (const image::ContentMissing& error) {
    throw image::ContentMissing(file + ": " + error.what());
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
  mended |= usePictures(root);
  if (!mended) return;
  made_ = buffers.takeMade();
  mended_ = withJson(file, root.dump());
}

const std::string* GltfInput::madeAt(const std::string& path) const {
  const auto found = made_.find(std::filesystem::path(path).filename().string());
  return found == made_.end() ? nullptr : &found->second;
}

bool GltfInput::Exists(const char* path) const {
  return madeAt(path) != nullptr || DefaultIOSystem::Exists(meantPath(path).c_str());
}

Assimp::IOStream* GltfInput::Open(const char* path, const char* mode) {
  if (!mended_.empty() && path == file_) return streamOf(mended_);
  if (const std::string* const made = madeAt(path)) return streamOf(*made);
  return DefaultIOSystem::Open(meantPath(path).c_str(), mode);
}

}  // namespace sunlit::scene
