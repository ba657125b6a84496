#include "scene/collada_effects.h"

#include <algorithm>
#include <cstdlib>

#include "scene/collada_tags.h"

namespace sunlit::scene {
namespace {

/// Up to the next tag.
std::string contentBehind(std::size_t at, const std::string& text) {
  return text.substr(at, std::min(text.find('<', at), text.size()) - at);
}

/// How the pictures of effects are meant, by their ids.
std::map<std::string, OpacityPicture> transparencyOfEffects(const std::string& text) {
  struct {
    std::string effect, opaque, above;  // the latter: the last tag
    OpacityPicture picture;
  } now;
  std::map<std::string, OpacityPicture> pictures;
  forEachTag(text, [&](const std::string& name, const std::string& tag, std::size_t at) {
    if (name == "effect") now = {valueInTag(tag, "id"), {}, {}, {}};
    if (name == "transparent") now.opaque = valueInTag(tag, "opaque");
    if (name == "texture" && now.above == "transparent" && !now.opaque.empty() && now.opaque != "A_ONE") {
      now.picture.is_transparency = now.opaque != "RGB_ONE";
      now.picture.of_colors = now.opaque != "A_ZERO";
      pictures.emplace(now.effect, now.picture);
    }
    if (name == "float" && now.above == "transparency") {
      now.picture.share = std::strtof(contentBehind(at + tag.size(), text).c_str(), nullptr);
      if (const auto known = pictures.find(now.effect); known != pictures.end())
        known->second.share = now.picture.share;
    }
    now.above = name;
  });
  return pictures;
}

}  // namespace

std::map<std::string, OpacityPicture> transparencyOf(const std::string& text) {
  const std::map<std::string, OpacityPicture> of_effects = transparencyOfEffects(text);
  std::map<std::string, OpacityPicture> of_materials;
  std::string material;
  forEachTag(text, [&](const std::string& name, const std::string& tag, std::size_t) {
    if (name == "material") material = valueInTag(tag, valueInTag(tag, "name").empty() ? "id" : "name");
    if (name != "instance_effect") return;
    const auto found = of_effects.find(withoutHash(valueInTag(tag, "url")));
    if (found != of_effects.end()) of_materials.emplace(material, found->second);
  });
  return of_materials;
}

}  // namespace sunlit::scene
