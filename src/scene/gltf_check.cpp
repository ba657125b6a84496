#include "scene/gltf_check.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "scene/gltf_json.h"
#include "scene/triangle_budget.h"

namespace sunlit::scene {
namespace {

using nlohmann::json;

constexpr std::uint64_t kTriangles = 4, kLastMode = 6;  ///< of a primitive (glTF 2.0, section 5.24)

std::uint64_t bytesOfComponent(std::uint64_t type) {
  constexpr std::uint64_t kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123;
  return type == kByte || type == kUnsignedByte ? 1 : type == kShort || type == kUnsignedShort ? 2 : 4;
}

class Check {
 public:
  Check(const json& root, const std::string& file) : root_(root), file_(file) {}

  void run() {
    for (std::size_t i = 0; i < list("bufferViews").size(); ++i)
      checkView(list("bufferViews")[i], "view " + std::to_string(i));
    for (std::size_t i = 0; i < list("accessors").size(); ++i)
      checkAccessor(list("accessors")[i], "accessor " + std::to_string(i));
    for (std::size_t i = 0; i < list("meshes").size(); ++i) {
      for (const json& primitive : child(list("meshes")[i], "primitives"))
        checkPrimitive(primitive, "mesh " + std::to_string(i));
    }
    for (std::size_t i = 0; i < list("skins").size(); ++i)
      checkSkin(list("skins")[i], "skin " + std::to_string(i));
    checkParents();
    checkLevels();
    checkForms();
  }

 private:
  [[noreturn]] void fail(const std::string& place, const std::string& wrong) const {
    throw std::runtime_error(file_ + ": " + place + " " + wrong);
  }

  [[noreturn]] void failOf(const json& value, const std::string& key, const std::string& place,
                           const std::string& wanted) const {
    fail(place, "has " + key + " " + value.dump(-1, ' ', false, json::error_handler_t::replace) +
                    ", but it must be " + wanted);
  }

  /// Of objects; empty where there is none.
  const json& list(const char* name) const {
    static const json none = json::array();
    const json& found = child(root_, name);
    return found.is_array() ? found : none;
  }

  std::uint64_t whole(const json& from, const char* key, std::uint64_t usual,
                      const std::string& place) const {
    const auto found = from.find(key);
    if (found == from.end()) return usual;
    constexpr std::uint64_t kLargest = 0xFFFFFFFF;
    if (!found->is_number_unsigned() || found->get<std::uint64_t>() > kLargest)
      failOf(*found, key, place, "a whole number from 0 to 4294967295");
    return found->get<std::uint64_t>();
  }

  /// The one of `name` that `key` of `from` tells; null where there is none, which Assimp finds.
  const json* one(const char* name, const json& from, const char* key) const {
    const auto found = from.find(key);
    if (found == from.end() || !found->is_number_unsigned()) return nullptr;
    const auto index = found->get<std::uint64_t>();
    return index < list(name).size() ? &list(name)[index] : nullptr;
  }

  /// `bytes` from `offset` on are within the view that `from` tells.
  void requireWithin(const json& from, std::uint64_t offset, std::uint64_t bytes,
                     const std::string& place) const {
    const json* const view = one("bufferViews", from, "bufferView");
    if (view == nullptr) return;
    const std::uint64_t length = whole(*view, "byteLength", 0, place + ": its view");
    if (offset + bytes > length) {
      fail(place, "reaches to byte " + std::to_string(offset + bytes) + " of its view, which has " +
                      std::to_string(length));
    }
  }

  /// Assimp sees to it that buffers are as long as they say.
  void checkView(const json& view, const std::string& place) const {
    if (!view.is_object()) return;
    const std::uint64_t end = whole(view, "byteOffset", 0, place) + whole(view, "byteLength", 0, place);
    const json* const buffer = one("buffers", view, "buffer");
    if (buffer == nullptr || !buffer->is_object()) return;
    const std::uint64_t length = whole(*buffer, "byteLength", 0, place + ": its buffer");
    if (end > length)
      fail(place,
           "reaches to byte " + std::to_string(end) + " of its buffer, which has " + std::to_string(length));
  }

  void checkAccessor(const json& accessor, const std::string& place) const {
    if (!accessor.is_object()) return;
    const std::uint64_t count = whole(accessor, "count", 0, place);
    const std::uint64_t element =
        bytesOfComponent(whole(accessor, "componentType", 0, place)) * numbersOfElement(accessor);
    const std::uint64_t offset = whole(accessor, "byteOffset", 0, place);
    if (const json* const view = one("bufferViews", accessor, "bufferView")) {
      const std::uint64_t stride = whole(*view, "byteStride", 0, place + ": its view");
      // Assimp counts the stride of the last element, too.
      if (count > 0)
        requireWithin(accessor, offset, (count - 1) * (stride == 0 ? element : stride) + element, place);
    }
    const json& sparse = child(accessor, "sparse");
    if (sparse.empty()) return;
    constexpr std::uint64_t kMost_bytes = std::uint64_t{1} << 30;
    if (count * element > kMost_bytes) fail(place, "is sparse, and of more than 1 GiB");
    requireWithin(accessor, offset, count * element, place);
    const std::uint64_t changed = whole(sparse, "count", 0, place);
    for (const char* const part : {"indices", "values"}) {
      const json& there = child(sparse, part);
      if (one("bufferViews", there, "bufferView") == nullptr)
        fail(place, std::string("is sparse, but has no ") + part);
      const bool is_index = std::string(part) == "indices";
      const std::uint64_t each =
          is_index ? bytesOfComponent(whole(there, "componentType", 0, place)) : element;
      requireWithin(there, whole(there, "byteOffset", 0, place), changed * each, place + ": " + part);
    }
  }

  std::uint64_t countOf(const json& from, const char* key, const std::string& place) const {
    const json* const accessor = one("accessors", from, key);
    return accessor == nullptr ? 0 : whole(*accessor, "count", 0, place);
  }

  void checkPrimitive(const json& primitive, const std::string& place) {
    const json& attributes = child(primitive, "attributes");
    const std::uint64_t mode = whole(primitive, "mode", kTriangles, place);
    if (mode > kLastMode) fail(place, "has mode " + std::to_string(mode) + ", but must have 0 to 6");
    const std::uint64_t corners = primitive.contains("indices") ? countOf(primitive, "indices", place)
                                                                : countOf(attributes, "POSITION", place);
    // Assimp makes a face of each triangle, line and point, and gives each primitive vertices of its own,
    // once more for each of its targets.
    const std::uint64_t vertices = countOf(attributes, "POSITION", place);
    budget_.take(mode == kTriangles ? corners / 3 : corners,
                 vertices * (1 + child(primitive, "targets").size()), file_ + ": " + place);
    const std::uint64_t weights = countOf(attributes, "WEIGHTS_0", place);
    std::size_t sets[2] = {0, 0};
    for (const auto& [name, value] : attributes.items()) {
      const bool is_joints = name.compare(0, 6, "JOINTS") == 0,
                 is_weights = name.compare(0, 7, "WEIGHTS") == 0;
      if (!is_joints && !is_weights) continue;
      ++sets[is_joints ? 0 : 1];
      if (countOf(attributes, name.c_str(), place) != weights)
        fail(place, "has another number of " + name + " than of WEIGHTS_0");
    }
    if (sets[0] != sets[1]) fail(place, "has not as many sets of joints as of weights");
    if (weights > countOf(attributes, "POSITION", place)) fail(place, "has more weights than vertices");
  }

  void checkSkin(const json& skin, const std::string& place) const {
    if (one("accessors", skin, "inverseBindMatrices") == nullptr) return;
    const std::size_t joints = child(skin, "joints").size();
    if (countOf(skin, "inverseBindMatrices", place) < joints)
      fail(place, "has fewer matrices than its " + std::to_string(joints) + " joints");
  }

  /// Nodes form strict trees (glTF 2.0, section 3.5.2). Where they do not, each way to a node would be one
  /// more of it: 2ⁿ of n nodes that are below each other twice.
  void checkParents() const {
    const json& nodes = list("nodes");
    std::vector<bool> has_parent(nodes.size(), false);
    for (const json& node : nodes) {
      for (const json& one : child(node, "children")) {
        if (!one.is_number_unsigned() || one.get<std::size_t>() >= nodes.size()) continue;
        const auto below = one.get<std::size_t>();
        if (has_parent[below]) fail("node " + std::to_string(below), "is below two others");
        has_parent[below] = true;
      }
    }
  }

  /// Of nodes below each other. Circles Assimp finds itself.
  void checkLevels() const {
    constexpr std::size_t kMost = 1000;
    const json& nodes = list("nodes");
    std::set<std::size_t> at;
    for (std::size_t i = 0; i < nodes.size(); ++i) at.insert(i);
    for (std::size_t depth = 0; !at.empty(); ++depth) {
      if (depth == kMost) fail("its nodes", "lie on more than 1000 levels, or go in circles");
      std::set<std::size_t> below;
      for (const std::size_t i : at) {
        for (const json& one : child(nodes[i], "children")) {
          if (one.is_number_unsigned() && one.get<std::size_t>() < nodes.size())
            below.insert(one.get<std::size_t>());
        }
      }
      at = std::move(below);
    }
  }

  void requireNumbers(const json& from, const char* key, std::size_t count, const std::string& place) const {
    const auto found = from.find(key);
    if (found == from.end()) return;
    const bool is_well =
        found->is_array() && found->size() == count &&
        std::all_of(found->begin(), found->end(), [](const json& one) { return one.is_number(); });
    if (!is_well) failOf(*found, key, place, std::to_string(count) + " numbers");
  }

  /// Of what Assimp passes over where it has another (glTF 2.0, sections 5.25, 5.19 and 5.22).
  void checkForms() const {
    for (std::size_t i = 0; i < list("nodes").size(); ++i) {
      const std::pair<const char*, std::size_t> all[] = {
          {"translation", 3}, {"rotation", 4}, {"scale", 3}, {"matrix", 16}};
      for (const auto& [key, count] : all)
        requireNumbers(list("nodes")[i], key, count, "node " + std::to_string(i));
    }
    for (std::size_t i = 0; i < list("materials").size(); ++i) {
      const json& material = list("materials")[i];
      const std::string place = "material " + std::to_string(i);
      requireNumbers(material, "emissiveFactor", 3, place);
      requireNumbers(child(material, "pbrMetallicRoughness"), "baseColorFactor", 4, place);
      const json& mode = child(material, "alphaMode");
      if (material.contains("alphaMode") && mode != "OPAQUE" && mode != "MASK" && mode != "BLEND")
        failOf(mode, "alphaMode", place, "OPAQUE, MASK or BLEND");
    }
  }

  const json& root_;
  const std::string& file_;
  TriangleBudget budget_;
};

}  // namespace

void requireReadableGltf(const json& root, const std::string& file) {
  Check(root, file).run();
}

}  // namespace sunlit::scene
