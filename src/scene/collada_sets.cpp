#include "scene/collada_sets.h"

#include <assimp/mesh.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <utility>

#include "scene/collada_tags.h"

namespace sunlit::scene {
namespace {

/// The sets by effect, and by what that calls its coordinates.
using Bindings = std::map<std::pair<std::string, std::string>, std::string>;

Bindings bindingsOf(const std::string& text) {
  std::map<std::string, std::string> effects;  // by material
  forEachTag(text, [&, material = std::string()](const std::string& name, const std::string& tag,
                                                 std::size_t) mutable {
    if (name == "material") material = valueInTag(tag, "id");
    if (name == "instance_effect") effects.emplace(material, withoutHash(valueInTag(tag, "url")));
  });
  Bindings bindings;
  forEachTag(text, [&, material = std::string()](const std::string& name, const std::string& tag,
                                                 std::size_t) mutable {
    if (name == "instance_material") material = withoutHash(valueInTag(tag, "target"));
    const std::string set = name == "bind_vertex_input" ? valueInTag(tag, "input_set") : "";
    if (!set.empty()) bindings.emplace(std::make_pair(effects[material], valueInTag(tag, "semantic")), set);
  });
  return bindings;
}

std::string withBoundNames(const std::string& text) {
  const Bindings bindings = bindingsOf(text);
  std::string renamed;
  std::size_t copied = 0;
  forEachTag(text, [&, effect = std::string()](const std::string& name, const std::string& tag,
                                               std::size_t at) mutable {
    if (name == "effect") effect = valueInTag(tag, "id");
    if (name != "texture") return;
    const auto bound = bindings.find({effect, valueInTag(tag, "texcoord")});
    const auto [begin, length] = placeInTag(tag, "texcoord");
    if (bound == bindings.end() || begin == std::string::npos) return;
    renamed.append(text, copied, at + begin - copied).append(bound->second);
    copied = at + begin + length;
  });
  return renamed.append(text, copied, std::string::npos);
}

/// Inputs of texture coordinates of one primitive.
struct CoordinateInputs {
  std::size_t at = 0;                ///< where the first begins
  std::map<long, std::string> tags;  ///< by set
};

/// What Assimp is to read before them.
std::string inputsThatLack(const CoordinateInputs& inputs) {
  std::string added;
  if (inputs.tags.empty()) return added;
  const std::string& lowest = inputs.tags.begin()->second;
  const long last = std::min<long>(inputs.tags.rbegin()->first, AI_MAX_NUMBER_OF_TEXTURECOORDS - 1);
  for (long set = 0; set < last; ++set) {
    if (inputs.tags.count(set) == 1) continue;
    added += R"(<input semantic="TEXCOORD" source=")" + valueInTag(lowest, "source") + R"(" offset=")" +
             valueInTag(lowest, "offset") + R"(" set=")" + std::to_string(set) + R"("/>)";
  }
  return added;
}

std::string withSetsFromZero(const std::string& text) {
  std::string filled;
  std::size_t copied = 0;
  CoordinateInputs inputs;
  const auto finish = [&] {
    const std::string added = inputsThatLack(inputs);
    if (!added.empty()) {
      filled.append(text, copied, inputs.at - copied).append(added);
      copied = inputs.at;
    }
    inputs.tags.clear();
  };
  forEachTag(text, [&](const std::string& name, const std::string& tag, std::size_t at) {
    if (name != "input") return finish();
    if (valueInTag(tag, "semantic") != "TEXCOORD" || valueInTag(tag, "offset").empty()) return;
    if (inputs.tags.empty()) inputs.at = at;
    inputs.tags.emplace(std::atol(valueInTag(tag, "set").c_str()), tag);
  });
  finish();
  return filled.append(text, copied, std::string::npos);
}

}  // namespace

std::string withKnownSets(const std::string& text) {
  return withSetsFromZero(withBoundNames(text));
}

}  // namespace sunlit::scene
