#include "scene/gltf_mend.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene/gltf_json.h"

namespace sunlit::scene {
namespace {

using nlohmann::json;

std::size_t leaveOutExtras(json& root) {
  std::size_t count = 0;
  for (json& list : root) {
    if (!list.is_array()) continue;
    for (json& one : list) {
      if (!one.is_object() || !one.contains("extras") || one["extras"].is_object()) continue;
      one.erase("extras");
      ++count;
    }
  }
  return count;
}

/// Of an accessor; many where it does not say so, which is wrong in other ways.
std::uint64_t countOf(const json& root, const json& index) {
  constexpr std::uint64_t kMany = 3;
  const json& accessors = child(root, "accessors");
  if (!index.is_number_unsigned() || !accessors.is_array()) return kMany;
  const auto number = index.get<std::uint64_t>();
  if (number >= accessors.size()) return kMany;
  const json& count = child(accessors[number], "count");
  return count.is_number_unsigned() ? count.get<std::uint64_t>() : kMany;
}

/// Positions are optional (glTF 2.0, section 3.7.2.1); without, or with too few corners, nothing is drawn.
bool isVoid(const json& root, const json& primitive) {
  if (!primitive.is_object()) return false;
  const json& attributes = child(primitive, "attributes");
  if (!attributes.is_object() || !attributes.contains("POSITION")) return true;
  const json& mode = child(primitive, "mode");
  const std::uint64_t kind = mode.is_number_unsigned() ? mode.get<std::uint64_t>() : 4;
  const std::uint64_t least = kind == 0 ? 1 : kind < 4 ? 2 : 3;  // points, lines, triangles
  return countOf(root, attributes["POSITION"]) == 0 ||
         countOf(root, primitive.contains("indices") ? primitive["indices"] : attributes["POSITION"]) < least;
}

std::size_t leaveOutPrimitives(json& root) {
  std::size_t count = 0;
  if (!child(root, "meshes").is_array()) return count;
  for (json& mesh : root["meshes"]) {
    if (!child(mesh, "primitives").is_array()) continue;
    json kept = json::array();
    for (json& primitive : mesh["primitives"]) {
      if (!isVoid(root, primitive)) kept.push_back(primitive);
    }
    count += mesh["primitives"].size() - kept.size();
    if (kept.size() < mesh["primitives"].size()) mesh["primitives"] = std::move(kept);
  }
  return count;
}

/// Of all nodes that are below no other.
bool makeScene(json& root) {
  const json& nodes = child(root, "nodes");
  if (!child(root, "scenes").empty() || !nodes.is_array() || nodes.empty()) return false;
  std::set<std::uint64_t> below;
  for (const json& node : nodes) {
    for (const json& one : child(node, "children")) {
      if (one.is_number_unsigned()) below.insert(one.get<std::uint64_t>());
    }
  }
  json roots = json::array();
  for (std::uint64_t i = 0; i < nodes.size(); ++i) {
    if (below.count(i) == 0) roots.push_back(i);
  }
  root["scenes"] = json::array({json{{"nodes", std::move(roots)}}});
  root["scene"] = 0U;
  return true;
}

/// Of the accessors of shapes. What Draco packs is in no view either.
std::set<std::size_t> accessorsOfShapes(const json& root) {
  std::set<std::size_t> found;
  const auto note = [&found](const json& index) {
    if (index.is_number_unsigned()) found.insert(index.get<std::size_t>());
  };
  for (const json& mesh : child(root, "meshes")) {
    for (const json& primitive : child(mesh, "primitives")) {
      if (!extension(primitive, kDraco).empty()) continue;
      note(child(primitive, "indices"));
      for (const json& index : child(primitive, "attributes")) note(index);
      for (const json& target : child(primitive, "targets")) {
        for (const json& index : target) note(index);
      }
    }
  }
  for (const json& skin : child(root, "skins")) note(child(skin, "inverseBindMatrices"));
  return found;
}

/// No less than those of its elements.
std::size_t bytesOfElements(const json& accessor, std::size_t number) {
  constexpr std::size_t kMost_bytes = std::size_t{1} << 30, kComponent_bytes = 4;
  const std::size_t element = kComponent_bytes * numbersOfElement(accessor),
                    count = indexOf(accessor, "count", 0);
  if (count > kMost_bytes / element)
    throw std::runtime_error("accessor " + std::to_string(number) +
                             " is in no view, so all of zeros, and of more than 1 GiB");
  return count * element;
}

}  // namespace

bool giveZeros(json& root, GltfBuffers& buffers) {
  std::size_t bytes = 0;
  const std::size_t view = child(root, "bufferViews").size(), buffer = child(root, "buffers").size();
  for (const std::size_t number : accessorsOfShapes(root)) {
    if (number >= child(root, "accessors").size()) continue;  // Assimp says so
    json& accessor = root["accessors"][number];
    if (!accessor.is_object() || accessor.contains("bufferView") || accessor.contains("sparse")) continue;
    const std::size_t needed = bytesOfElements(accessor, number);
    if (needed == 0) continue;
    bytes = std::max(bytes, needed);
    accessor["bufferView"] = view;
    accessor.erase("byteOffset");
  }
  if (bytes == 0) return false;
  root["bufferViews"].push_back(json{{"buffer", buffer}, {"byteLength", bytes}});
  buffers.add(std::string(bytes, '\0'));
  return true;
}

std::size_t makeUnit(json& root) {
  constexpr double kOff = 0.01;  // whole numbers of 8 bits are off by that
  std::size_t count = 0;
  if (!child(root, "nodes").is_array()) return count;
  for (json& node : root["nodes"]) {
    const json& turn = child(node, "rotation");
    const auto is_number = [](const json& one) { return one.is_number(); };
    if (!turn.is_array() || turn.size() != 4 || !std::all_of(turn.begin(), turn.end(), is_number)) continue;
    Eigen::Vector4d quaternion;
    for (int i = 0; i < 4; ++i) quaternion[i] = turn[static_cast<std::size_t>(i)].get<double>();
    const double length = quaternion.norm();
    if (!std::isfinite(length) || std::abs(length - 1.0) < kOff) continue;
    ++count;
    quaternion = length > 0.0 ? Eigen::Vector4d(quaternion / length) : Eigen::Vector4d(0.0, 0.0, 0.0, 1.0);
    node["rotation"] = std::vector<double>(quaternion.data(), quaternion.data() + 4);
  }
  return count;
}

GltfMends mendGltf(json& root) {
  GltfMends mends;
  mends.extras = leaveOutExtras(root);
  mends.primitives = leaveOutPrimitives(root);
  mends.turns = makeUnit(root);
  mends.scene = makeScene(root);
  return mends;
}

}  // namespace sunlit::scene
