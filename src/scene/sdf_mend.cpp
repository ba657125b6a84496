#include "scene/sdf_mend.h"

#include <map>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "scene/sdf_remarks.h"
#include "scene/sdf_xml.h"
#include "sunlit/quantity/columns.h"

namespace sunlit::scene {
namespace {

using tinyxml2::XMLElement;
using Words = std::set<std::string>;

/// The children of an element, but for attributes and values.
struct Children {
  Words kept;
  Words unseen;     ///< known, and nothing that a camera sees
  Words not_drawn;  ///< seen in a simulator
};

/// SDF 1.4 to 1.9, elements, and the cone of 1.11.
const std::map<std::string, Children> kChildren = {
    {"sdf", {{"world", "model", "light"}, {}, {"actor"}}},
    {"world",
     {{"include", "model", "light", "frame", "road"},
      {"atmosphere", "audio", "gravity", "gui", "joint", "magnetic_field", "physics", "plugin", "scene",
       "spherical_coordinates", "wind"},
      {"actor", "population"}}},
    {"model",
     {{"pose", "include", "model", "link", "frame", "joint"},
      {"allow_auto_disable", "enable_wind", "gripper", "plugin", "self_collide", "static"},
      {}}},
    {"link",
     {{"pose", "visual", "light"},
      {"audio_sink", "audio_source", "battery", "collision", "enable_wind", "frame", "gravity", "inertial",
       "kinematic", "must_be_base_link", "plugin", "self_collide", "sensor", "velocity_decay"},
      {"particle_emitter", "projector"}}},
    {"visual",
     {{"pose", "geometry", "material", "transparency", "cast_shadows"},
      {"frame", "laser_retro", "meta", "plugin", "visibility_flags"},
      {}}},
    {"geometry",
     {{"box", "capsule", "cone", "cylinder", "ellipsoid", "empty", "heightmap", "image", "mesh", "plane",
       "polyline", "sphere"},
      {"frame"},
      {}}},
};

/// Shapes of numbers alone, and what of them has none below 0.
const Words kSolids = {"box", "capsule", "cone", "cylinder", "ellipsoid", "plane", "sphere"};
const Words kLengths = {"length", "radii", "radius", "size"};

const Words kLightTypes = {"point", "spot", "directional"};

/// The newest version that libsdformat 12 reads is 1.9, and the elements above are those from 1.4 on.
constexpr int kNewest = 9;
constexpr int kOldestPruned = 4;
/// From here on "::" stands between the names of nested models, and in none of them.
constexpr int kScopedNames = 8;

/// n of version 1.n; −1 for any other.
int minorVersion(const XMLElement& sdf) {
  const std::string version = attributeOf(sdf, "version");
  const bool plain = version.size() == 3 && version.compare(0, 2, "1.") == 0;
  return plain && version[2] >= '0' && version[2] <= '9' ? version[2] - '0' : -1;
}

/// What libsdformat is strict about in links of older versions, and nobody sees.
bool isUnseenOfOld(const XMLElement& element, const XMLElement& parent) {
  const std::string kind = element.Value();
  return std::string(parent.Value()) == "link" &&
         (kind == "collision" || kind == "inertial" || kind == "sensor");
}

/// How many numbers there are in `text`; 0 where there is anything else.
std::size_t numbersIn(const std::string& text) {
  std::istringstream words(text);
  std::size_t numbers = 0;
  for (double number; words >> number;) ++numbers;
  return words.eof() ? numbers : 0;
}

class Mender {
 public:
  Mender(const std::string& file, int version, SceneBuilder& builder)
      : file_(file), version_(version), builder_(builder) {}

  void mend(XMLElement& sdf) {
    remarkOnSdf(sdf, file_, builder_);
    if (version_ >= kOldestPruned) {
      prune(sdf);
    } else {
      dropUnseen(sdf);
    }
    forEachBelow(sdf, [&](XMLElement& element) { noteReferences(element); });
    mendBelow(sdf);
  }

 private:
  void prune(XMLElement& parent) {
    const auto known = kChildren.find(parent.Value());
    if (known == kChildren.end()) return;
    const Children& children = known->second;
    for (XMLElement* child : childrenOf(parent)) {
      const std::string name = child->Value();
      if (children.kept.count(name) == 1) {
        prune(*child);
        continue;
      }
      const bool of_others = name.find(':') != std::string::npos;
      if (children.not_drawn.count(name) == 1) {
        builder_.warn("elements were left out, they are of kinds that are not drawn",
                      described(*child, file_));
      } else if (children.unseen.count(name) == 0 && !of_others) {
        builder_.warn("elements were passed over, SDF has none of that name there",
                      described(*child, file_) + " in <" + parent.Value() + ">");
      }
      parent.DeleteChild(child);
    }
  }

  /// Of older versions, whose elements stand elsewhere.
  static void dropUnseen(XMLElement& parent) {
    for (XMLElement* child : childrenOf(parent)) {
      if (isUnseenOfOld(*child, parent)) {
        parent.DeleteChild(child);
      } else {
        dropUnseen(*child);
      }
    }
  }

  void noteReferences(const XMLElement& element) {
    for (const char* attribute : {"relative_to", "attached_to", "placement_frame"})
      noteReference(attributeOf(element, attribute));
    if (std::string(element.Value()) == "include") noteReference(childText(element, "placement_frame"));
  }

  void noteReference(const std::string& name) {
    const std::size_t scope = name.rfind("::");
    referenced_.insert(scope == std::string::npos ? name : name.substr(scope + 2));
  }

  void mendBelow(XMLElement& parent) {
    const std::string kind = parent.Value();
    remarkOnNumbers(parent, file_, builder_);
    if (kind == "sdf") nameWorlds(parent);
    if (kind == "model") mendModel(parent);
    if (kind == "pose") mendPose(parent);
    if (kind == "visual") mendVisual(parent);
    if (kind == "material") mendMaterial(parent);
    if (kind == "heightmap") mendHeightmap(parent);
    dropUnknownLights(parent);
    if (kind == "world" || kind == "model" || kind == "link") nameChildren(parent);
    for (XMLElement* child : childrenOf(parent)) mendBelow(*child);
  }

  /// libsdformat gives up a world of one whose type it does not know.
  void dropUnknownLights(XMLElement& parent) {
    for (XMLElement* light : childrenOf(parent, "light")) {
      const std::string type = trimmed(attributeOf(*light, "type"));
      if (kLightTypes.count(type) == 1) continue;
      builder_.warn("lights were left out, they are of none of the types point, spot and directional",
                    described(*light, file_) + (type.empty() ? " has no type" : " has type " + type));
      parent.DeleteChild(light);
    }
  }

  /// Whether others that include this file may refer to a joint, which must then not be one that
  /// libsdformat refuses as a frame: of a link, at a place of its own, by a name of its own.
  static bool isAsked(const XMLElement& joint, XMLElement& model) {
    if (std::string(model.Parent()->Value()) != "sdf") return false;
    const std::string name = attributeOf(joint, "name"), child = childText(joint, "child");
    const XMLElement* pose = joint.FirstChildElement("pose");
    if (name.empty() || (pose != nullptr && !attributeOf(*pose, "relative_to").empty())) return false;
    bool of_link = false, taken = false;
    for (const XMLElement* other : childrenOf(model)) {
      const bool include = std::string(other->Value()) == "include";
      const std::string other_name = include ? childText(*other, "name") : attributeOf(*other, "name");
      of_link |= std::string(other->Value()) == "link" && other_name == child;
      taken |= other != &joint && other_name == name;
    }
    return of_link && !taken;
  }

  /// Nothing falls here, so that a model needs no link; and a frame stands where its joint would.
  void mendModel(XMLElement& model) {
    model.DeleteAttribute("canonical_link");
    childIn(model, "static").SetText("true");
    for (XMLElement* joint : childrenOf(model, "joint")) {
      const std::string child = childText(*joint, "child");
      if (child.empty() || (referenced_.count(attributeOf(*joint, "name")) == 0 && !isAsked(*joint, model))) {
        model.DeleteChild(joint);
        continue;
      }
      joint->SetName("frame");
      joint->DeleteAttribute("type");
      joint->SetAttribute("attached_to", child.c_str());
      for (XMLElement* part : childrenOf(*joint)) {
        if (std::string(part->Value()) != "pose") joint->DeleteChild(part);
      }
    }
  }

  /// Gazebo takes less than six numbers; and on a frame without a name libsdformat's converter gives up.
  void mendPose(XMLElement& pose) {
    for (const char* frame : {"frame", "relative_to"}) {
      if (attributeOf(pose, frame).empty()) pose.DeleteAttribute(frame);
    }
    const std::string text = pose.GetText() == nullptr ? "" : pose.GetText();
    const std::string format = attributeOf(pose, "rotation_format");
    const std::size_t given = numbersIn(text);
    if (given == 0 || given >= 6 || !(format.empty() || format == "euler_rpy")) return;
    std::string whole = text;
    for (std::size_t i = given; i < 6; ++i) whole += " 0";
    pose.SetText(whole.c_str());
    builder_.warn("poses have less than six numbers, the others are 0", text + " at " + placeOf(file_, pose));
  }

  void mendVisual(XMLElement& visual) {
    XMLElement& geometry = childIn(visual, "geometry");
    if (geometry.FirstChildElement() == nullptr) newChildIn(geometry, "empty");
    std::size_t shapes = 0;
    for (XMLElement* shape : childrenOf(geometry)) {
      const std::string kind = shape->Value();
      const bool is_one_of_many = kind == "polyline" && shape->PreviousSiblingElement("polyline") != nullptr;
      if (!is_one_of_many) ++shapes;
      for (XMLElement* part : childrenOf(*shape)) {
        if (kSolids.count(kind) == 1 && kLengths.count(part->Value()) == 1) mendLengths(*part);
      }
    }
    if (shapes > 1)
      builder_.warn("geometries hold several shapes, one of them is drawn", described(geometry, file_));
  }

  void mendLengths(XMLElement& lengths) {
    const std::string text = lengths.GetText() == nullptr ? "" : lengths.GetText();
    std::istringstream words(text);
    std::string positive;
    bool has_negative = false;
    for (std::string word; words >> word;) {
      const bool is_negative = word.size() > 1 && word[0] == '-';
      positive += (positive.empty() ? "" : " ") + word.substr(is_negative ? 1 : 0);
      has_negative |= is_negative;
    }
    if (!has_negative) return;
    lengths.SetText(positive.c_str());
    builder_.warn("lengths are negative, they are taken as positive",
                  described(lengths, file_) + " is " + text);
  }

  /// Nothing refers to a world by its name, and many are called "world", which is reserved.
  static void nameWorlds(XMLElement& sdf) {
    int worlds = 0;
    for (XMLElement* world : childrenOf(sdf, "world"))
      world->SetAttribute("name", ("world " + std::to_string(++worlds)).c_str());
  }

  /// A script that names no file is one of Gazebo's own; one that names no material says nothing. What is not
  /// given, saved worlds call "__default__".
  static void mendMaterial(XMLElement& material) {
    const auto isGiven = [](const XMLElement& script, const char* part) {
      const std::string text = childText(script, part);
      return !text.empty() && text != "__default__";
    };
    for (XMLElement* script : childrenOf(material, "script")) {
      if (!isGiven(*script, "name")) {
        material.DeleteChild(script);
      } else if (!isGiven(*script, "uri")) {
        childIn(*script, "uri").SetText("file://media/materials/scripts/gazebo.material");
      }
    }
  }

  /// libsdformat wants a normal map.
  static void mendHeightmap(XMLElement& heightmap) {
    for (XMLElement* texture : childrenOf(heightmap, "texture")) {
      if (childText(*texture, "normal").empty()) childIn(*texture, "normal").SetText(kNoNormals);
    }
  }

  /// Models, links and frames of one scope are told apart by their names alone, visuals and lights among
  /// themselves.
  void nameChildren(XMLElement& parent) {
    std::map<std::string, Words> taken;
    for (XMLElement* child : childrenOf(parent)) {
      const std::string kind = child->Value();
      const bool frame = kind == "model" || kind == "link" || kind == "frame" || kind == "include";
      if (!frame && kind != "visual" && kind != "light" && kind != "road") continue;
      const bool include = kind == "include";
      const std::string before = include ? childText(*child, "name") : attributeOf(*child, "name");
      const std::string name = freeName(accepted(before, kind), &taken[frame ? "" : kind]);
      if (name == before) continue;
      builder_.warn("names are missing, reserved or given twice, others stand in for them",
                    (before.empty() ? "none" : before) + " at " + placeOf(file_, *child) + " is now " + name);
      if (include) {
        childIn(*child, "name").SetText(name.c_str());
      } else {
        child->SetAttribute("name", name.c_str());
      }
    }
  }

  std::string accepted(std::string name, const std::string& kind) const {
    if (name.empty()) name = kind;
    for (std::size_t at = name.find("::"); version_ >= kScopedNames && at != std::string::npos;
         at = name.find("::"))
      name.replace(at, 2, "_");
    const bool reserved = name == "world" || (name.size() >= 4 && name.compare(0, 2, "__") == 0 &&
                                              name.compare(name.size() - 2, 2, "__") == 0);
    return reserved ? name + "-" : name;
  }

  static std::string freeName(const std::string& wanted, Words* taken) {
    std::string name = wanted;
    for (int i = 2; !taken->insert(name).second; ++i) name = wanted + "-" + std::to_string(i);
    return name;
  }

  const std::string& file_;
  int version_;
  SceneBuilder& builder_;
  Words referenced_;
};

}  // namespace

bool isTakenOut(const XMLElement& element, const XMLElement& sdf) {
  const XMLElement& parent = *element.Parent()->ToElement();
  const int version = minorVersion(sdf);
  if (version >= 0 && version < kOldestPruned) return isUnseenOfOld(element, parent);
  const auto known = kChildren.find(parent.Value());
  return known != kChildren.end() && known->second.kept.count(element.Value()) == 0;
}

bool isOfKnownChildren(const XMLElement& sdf) {
  return minorVersion(sdf) >= kOldestPruned;
}

bool isMendedWithin(const std::string& parent) {
  return kChildren.count(parent) == 1;
}

bool mayRemain(const std::string& parent, const std::string& child) {
  // Of joints frames remain, or nothing; and every model gets a <static>.
  if (parent == "model" && (child == "joint" || child == "static")) return child == "static";
  return kChildren.at(parent).kept.count(child) == 1;
}

void mendSdf(XMLElement& sdf, const std::string& file, SceneBuilder& builder) {
  int version = minorVersion(sdf);
  if (version < 0) {
    const std::string written = attributeOf(sdf, "version");
    builder.warn("files are of a version of SDF that is not known, they are read as 1.9",
                 file + " of " + (written.empty() ? "none" : written));
    sdf.SetAttribute("version", "1.9");
    version = kNewest;
  }
  Mender(file, version, builder).mend(sdf);
}

void keepFirstWorld(XMLElement& sdf, const std::string& file, SceneBuilder& builder) {
  bool first = true;
  for (XMLElement* world : childrenOf(sdf, "world")) {
    if (std::exchange(first, false)) continue;
    builder.warn("worlds were left out, of several in a file the first is drawn",
                 attributeOf(*world, "name") + " at " + placeOf(file, *world));
    sdf.DeleteChild(world);
  }
}

}  // namespace sunlit::scene
