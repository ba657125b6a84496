#include "scene/collada_sets.h"

#include <assimp/mesh.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <utility>

namespace sunlit::scene {
namespace {

/// Calls use(name, tag, at) for each tag that opens an element.
template <typename Use>
void forEachTag(const std::string& text, Use use) {
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    const bool is_comment = text.compare(at, 4, "<!--") == 0;
    const std::size_t end = text.find(is_comment ? "-->" : ">", at);
    if (end == std::string::npos) return;
    if (!is_comment && text[at + 1] != '/') {
      const std::string tag = text.substr(at, end + 1 - at);
      use(tag.substr(1, tag.find_first_of(" \t\r\n/>", 1) - 1), tag, at);
    }
    at = end;
  }
}

/// Where the value of an attribute stands in its tag, and how long it is; nowhere, and 0, where there is
/// none.
std::pair<std::size_t, std::size_t> placeInTag(const std::string& tag, const std::string& attribute) {
  const std::string blanks = " \t\r\n";
  for (std::size_t at = tag.find(attribute, 1); at != std::string::npos; at = tag.find(attribute, at + 1)) {
    const std::size_t equals = tag.find_first_not_of(blanks, at + attribute.size());
    if (blanks.find(tag[at - 1]) == std::string::npos || equals == std::string::npos || tag[equals] != '=')
      continue;
    const std::size_t quote = tag.find_first_of("\"'", equals);
    const std::size_t end = quote == std::string::npos ? quote : tag.find(tag[quote], quote + 1);
    if (end != std::string::npos) return {quote + 1, end - quote - 1};
  }
  return {std::string::npos, 0};
}

/// Empty where there is none.
std::string valueOf(const std::string& tag, const std::string& attribute) {
  const auto [begin, length] = placeInTag(tag, attribute);
  return begin == std::string::npos ? "" : tag.substr(begin, length);
}

/// Of an address within the file.
std::string withoutHash(const std::string& address) {
  return address.compare(0, 1, "#") == 0 ? address.substr(1) : address;
}

/// The sets by effect, and by what that calls its coordinates.
using Bindings = std::map<std::pair<std::string, std::string>, std::string>;

Bindings bindingsOf(const std::string& text) {
  std::map<std::string, std::string> effects;  // by material
  forEachTag(text, [&, material = std::string()](const std::string& name, const std::string& tag,
                                                 std::size_t) mutable {
    if (name == "material") material = valueOf(tag, "id");
    if (name == "instance_effect") effects.emplace(material, withoutHash(valueOf(tag, "url")));
  });
  Bindings bindings;
  forEachTag(text, [&, material = std::string()](const std::string& name, const std::string& tag,
                                                 std::size_t) mutable {
    if (name == "instance_material") material = withoutHash(valueOf(tag, "target"));
    const std::string set = name == "bind_vertex_input" ? valueOf(tag, "input_set") : "";
    if (!set.empty()) bindings.emplace(std::make_pair(effects[material], valueOf(tag, "semantic")), set);
  });
  return bindings;
}

std::string withBoundNames(const std::string& text) {
  const Bindings bindings = bindingsOf(text);
  std::string renamed;
  std::size_t copied = 0;
  forEachTag(text, [&, effect = std::string()](const std::string& name, const std::string& tag,
                                               std::size_t at) mutable {
    if (name == "effect") effect = valueOf(tag, "id");
    if (name != "texture") return;
    const auto bound = bindings.find({effect, valueOf(tag, "texcoord")});
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
    added += R"(<input semantic="TEXCOORD" source=")" + valueOf(lowest, "source") + R"(" offset=")" +
             valueOf(lowest, "offset") + R"(" set=")" + std::to_string(set) + R"("/>)";
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
    if (valueOf(tag, "semantic") != "TEXCOORD" || valueOf(tag, "offset").empty()) return;
    if (inputs.tags.empty()) inputs.at = at;
    inputs.tags.emplace(std::atol(valueOf(tag, "set").c_str()), tag);
  });
  finish();
  return filled.append(text, copied, std::string::npos);
}

}  // namespace

std::string withKnownSets(const std::string& text) {
  return withSetsFromZero(withBoundNames(text));
}

}  // namespace sunlit::scene
