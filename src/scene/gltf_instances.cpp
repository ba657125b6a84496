#include "scene/gltf_instances.h"

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene/gltf_json.h"
#include "scene/gltf_numbers.h"
#include "sunlit/quantity/range.h"

namespace sunlit::scene {
namespace {

using nlohmann::json;

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";
constexpr std::size_t kMost = 100000;  ///< of a file: each becomes a mesh of its own

/// An attribute of places, by the word that a node has for it.
struct Attribute {
  const char* name;
  const char* of_node;
  std::size_t numbers;  ///< of each place
};
constexpr std::array<Attribute, 3> kAttributes = {
    {{"TRANSLATION", "translation", 3}, {"ROTATION", "rotation", 4}, {"SCALE", "scale", 3}}};

/// What nodes have that stand where `attributes` tell, by countIn() places; nothing where these tell none.
std::optional<std::vector<json>> placesOf(const json& root, const json& attributes, GltfBuffers& buffers) {
  std::optional<std::vector<json>> places;
  for (const Attribute& attribute : kAttributes) {
    if (!attributes.contains(attribute.name)) continue;
    const json& accessor = child(root, "accessors").at(indexOf(attributes.at(attribute.name)));
    if (numbersOfElement(accessor) != attribute.numbers)
      throw std::runtime_error(std::string(attribute.name) + " must have " +
                               std::to_string(attribute.numbers) + " numbers a place");
    const std::vector<float> numbers = floatsOf(root, accessor, buffers);
    const std::size_t count = numbers.size() / attribute.numbers;
    if (!places) places.emplace(count, json::object());
    for (std::size_t i = 0; i < count; ++i) {
      const auto from = numbers.begin() + static_cast<std::ptrdiff_t>(i * attribute.numbers);
      (*places)[i][attribute.of_node] =
          std::vector<float>(from, from + static_cast<std::ptrdiff_t>(attribute.numbers));
    }
  }
  return places;
}

/// How many places a node has that tells `attributes`, which all must have as many.
std::size_t countIn(const json& root, const json& attributes) {
  std::optional<std::size_t> count;
  for (const Attribute& attribute : kAttributes) {
    if (!attributes.contains(attribute.name)) continue;
    const std::size_t told =
        indexOf(child(root, "accessors").at(indexOf(attributes.at(attribute.name))).at("count"));
    if (count && told != *count)
      throw std::runtime_error(std::string(attribute.name) + " has " + std::to_string(told) +
                               " places, and another attribute " + std::to_string(*count));
    count = told;
  }
  return count.value_or(0);
}

}  // namespace

bool placeInstances(json& root, GltfBuffers& buffers) {
  if (!child(root, "nodes").is_array()) return false;  // Assimp says so
  const std::size_t nodes = child(root, "nodes").size();
  std::size_t placed = 0;
  bool any = false;
  for (std::size_t n = 0; n < nodes; ++n) {
    const json attributes = child(extension(root["nodes"][n], kInstancing), "attributes");
    if (attributes.empty() || !root["nodes"][n].contains("mesh")) continue;
    std::optional<std::vector<json>> places;
    try {
      placed += countIn(root, attributes);
      if (placed > kMost)
        throw std::runtime_error(refusal("the number of meshes up to here", std::to_string(placed),
                                         "from 0 to " + std::to_string(kMost)));
      places = placesOf(root, attributes, buffers);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error("node " + std::to_string(n) + ": " + kInstancing + ": " + error.what());
    }
    if (!places) continue;
    any = true;
    const json mesh = root["nodes"][n]["mesh"], name = root["nodes"][n].value("name", "");
    root["nodes"][n].erase("mesh");
    for (json& place : *places) {
      place["mesh"] = mesh;
      place["name"] = name;
      root["nodes"][n]["children"].push_back(root["nodes"].size());
      root["nodes"].push_back(std::move(place));
    }
  }
  return any;
}

}  // namespace sunlit::scene
