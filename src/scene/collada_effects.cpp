#include "scene/collada_effects.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <utility>

#include "scene/collada_tags.h"

namespace sunlit::scene {
namespace {

/// One <effect>.
struct Effect {
  std::optional<OpacityPicture> picture = {};  ///< how that in <transparent> is meant
  bool has_diffuse = false;
  std::set<std::string> parameters = {};
};

/// By their ids.
std::map<std::string, Effect> effectsById(const std::string& text) {
  struct {
    std::string effect, opaque, above;  // the latter: the last tag
    OpacityPicture picture;
  } now;
  std::map<std::string, Effect> effects;
  forEachTag(text, [&](const std::string& name, const std::string& tag, std::size_t at) {
    if (name == "effect") now = {valueInTag(tag, "id"), {}, {}, {}};
    Effect& effect = effects[now.effect];
    if (now.above == "diffuse" && (name == "color" || name == "texture")) effect.has_diffuse = true;
    if (name == "newparam") effect.parameters.insert(valueInTag(tag, "sid"));
    if (name == "transparent") now.opaque = valueInTag(tag, "opaque");
    if (name == "texture" && now.above == "transparent" && !now.opaque.empty() && now.opaque != "A_ONE") {
      now.picture.is_transparency = now.opaque != "RGB_ONE";
      now.picture.of_colors = now.opaque != "A_ZERO";
      if (!effect.picture) effect.picture = now.picture;
    }
    if (name == "float" && now.above == "transparency") {
      now.picture.share = std::strtof(contentBehind(at + tag.size(), text).c_str(), nullptr);
      if (effect.picture) effect.picture->share = now.picture.share;
    }
    now.above = name;
  });
  effects.erase("");  // of tags that stand in none
  return effects;
}

/// What stands in the place of a reference: an element that may stand there, whole. By effect and name.
using Parameters = std::map<std::pair<std::string, std::string>, std::string>;

Parameters parametersOf(const std::string& text) {
  Parameters parameters;
  std::string effect, parameter;
  forEachTag(text, [&](const std::string& name, const std::string& tag, std::size_t at) {
    if (name == "effect") effect = valueInTag(tag, "id");
    if (name == "newparam") parameter = valueInTag(tag, "sid");
    if (parameter.empty()) return;
    const std::string content = contentBehind(at + tag.size(), text);
    std::string element;
    if (name == "float") element = "<float>" + content + "</float>";
    if (name == "float3") element = "<color>" + content + " 1</color>";
    if (name == "float4") element = "<color>" + content + "</color>";
    if (element.empty()) return;
    // Lines stay where they are.
    std::replace_if(
        element.begin(), element.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    parameters.emplace(std::make_pair(effect, std::exchange(parameter, "")), element);
  });
  return parameters;
}

}  // namespace

ColladaEffects effectsOf(const std::string& text) {
  const std::map<std::string, Effect> effects = effectsById(text);
  ColladaEffects of_materials;
  std::string id, material;
  auto found = effects.end();
  forEachTag(text, [&](const std::string& name, const std::string& tag, std::size_t) {
    if (name == "material") {
      material = valueInTag(tag, valueInTag(tag, "name").empty() ? "id" : "name");
      id = valueInTag(tag, "id");
      of_materials.without_effect[id] = material;
    }
    if (name == "instance_effect") {
      found = effects.find(withoutHash(valueInTag(tag, "url")));
      if (found == effects.end()) return;
      of_materials.without_effect.erase(id);
      if (found->second.picture) of_materials.transparency.emplace(material, *found->second.picture);
      if (!found->second.has_diffuse) of_materials.without_diffuse.insert(material);
    }
    // Others are of profiles that nobody reads.
    if (name == "setparam" && found != effects.end() &&
        found->second.parameters.count(valueInTag(tag, "ref")) == 1)
      of_materials.set_apart.insert(material);
  });
  return of_materials;
}

void warnOf(const ColladaEffects& effects, const std::string& file, SceneBuilder& builder) {
  for (const auto& [id, material] : effects.without_effect)
    builder.warn("materials have no effect in their file: what has them is as without a material",
                 material + " of " + file);
  for (const std::string& material : effects.set_apart)
    builder.warn("materials set parameters of their effects by <setparam>, which is not read",
                 material + " of " + file);
}

std::string withParameters(const std::string& text) {
  const Parameters parameters = parametersOf(text);
  if (parameters.empty()) return text;
  std::string replaced, effect;
  std::size_t copied = 0;
  forEachTag(text, [&](const std::string& name, const std::string& tag, std::size_t at) {
    if (name == "effect") effect = valueInTag(tag, "id");
    const auto found = name == "param" ? parameters.find({effect, valueInTag(tag, "ref")}) : parameters.end();
    if (found == parameters.end() || at < copied) return;
    const std::string end = "</param>";
    const std::size_t behind = at + tag.size();
    const std::size_t next = tag[tag.size() - 2] == '/' ? behind : text.find(end, behind) + end.size();
    if (next < behind) return;  // XML that is broken
    replaced.append(text, copied, at - copied).append(found->second);
    copied = next;
  });
  return replaced.append(text, copied, std::string::npos);
}

}  // namespace sunlit::scene
