#include "scene/collada_morphs.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>

#include "scene/collada_tags.h"

namespace sunlit::scene {
namespace {

/// The controllers of a file.
struct Controllers {
  std::map<std::string, std::string> shape_of_morph;  ///< both by id
  std::set<std::string> skins;                        ///< by id
  std::vector<std::size_t> morphs;                    ///< where they begin in the text

  /// What a morph is of at last, which may be one itself; empty where that leads nowhere.
  std::string shapeOf(std::string id) const {
    for (std::size_t i = 0; i <= shape_of_morph.size(); ++i) {
      const auto found = shape_of_morph.find(id);
      if (found == shape_of_morph.end()) return id;
      id = found->second;
    }
    return "";
  }
};

Controllers controllersOf(const std::string& text) {
  Controllers controllers;
  std::string id;
  std::size_t begin = 0;
  forEachTag(text, [&](const std::string& name, const std::string& tag, std::size_t at) {
    if (name == "controller") {
      id = valueInTag(tag, "id");
      begin = at;
    } else if (name == "skin") {
      controllers.skins.insert(id);
    } else if (name == "morph") {
      controllers.shape_of_morph[id] = withoutHash(valueInTag(tag, "source"));
      controllers.morphs.push_back(begin);
    }
  });
  return controllers;
}

/// Takes what stands there out, but for the ends of its lines.
void takeOut(const std::string& text, std::size_t begin, const std::string& end, TextChanges* changes) {
  const std::size_t last = text.find(end, begin);
  if (last == std::string::npos) return;
  const std::size_t length = last + end.size() - begin;
  const auto from = text.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto lines = std::count(from, from + static_cast<std::ptrdiff_t>(length), '\n');
  (*changes)[begin] = {length, std::string(static_cast<std::size_t>(lines), '\n')};
}

/// Of a controller's instance, whose tag is at `at`, one of a geometry.
void makeGeometry(const std::string& text, const std::string& tag, std::size_t at, TextChanges* changes) {
  const std::string controller = "instance_controller", geometry = "instance_geometry";
  (*changes)[at + 1] = {controller.size(), geometry};
  if (tag[tag.size() - 2] == '/') return;
  const std::size_t end = text.find("</" + controller, at);
  if (end != std::string::npos) (*changes)[end + 2] = {controller.size(), geometry};
}

}  // namespace

ColladaMorphs withoutMorphs(const std::string& text) {
  const Controllers controllers = controllersOf(text);
  ColladaMorphs morphs;
  TextChanges changes;
  forEachTag(text, [&](const std::string& name, const std::string& tag, std::size_t at) {
    const bool is_instance = name == "instance_controller";
    if (!is_instance && name != "skin") return;
    const auto [begin, length] = placeInTag(tag, is_instance ? "url" : "source");
    if (length == 0) return;
    const std::string morph = withoutHash(tag.substr(begin, length)), shape = controllers.shapeOf(morph);
    if (shape == morph || shape.empty()) return;
    changes[at + begin] = {length, "#" + shape};
    if (is_instance && controllers.skins.count(shape) == 0) makeGeometry(text, tag, at, &changes);
    morphs.names.push_back(morph);
  });
  for (const std::size_t begin : controllers.morphs) takeOut(text, begin, "</controller>", &changes);
  morphs.text = changed(text, changes);
  return morphs;
}

}  // namespace sunlit::scene
