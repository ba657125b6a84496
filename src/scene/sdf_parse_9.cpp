/// libsdformat 9 knows SDF up to 1.7, in which models that are included are merged into those that include
/// them. Here a frame stands in the place of each, with those of its own links, frames and models that poses
/// refer to, as "included::link". What is newer than 1.7 is brought down to it, as far as it can be seen.
#include <algorithm>
#include <iomanip>
#include <optional>
#include <sdf/Frame.hh>
#include <sdf/Link.hh>
#include <sdf/World.hh>
#include <sdf/parser.hh>
#include <set>
#include <sstream>
#include <stdexcept>

#include "scene/sdf_library.h"
#include "scene/sdf_parse.h"
#include "scene/sdf_pose.h"
#include "scene/sdf_schema.h"
#include "scene/sdf_xml.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::scene {
namespace {

using tinyxml2::XMLElement;

/// With all digits.
std::string poseText(const ignition::math::Pose3d& pose) {
  std::ostringstream text;
  text << std::setprecision(17) << pose.Pos() << ' ' << pose.Rot().Euler();
  return text.str();
}

ignition::math::Pose3d toIgnition(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.linear());
  const Eigen::Vector3d t = pose.translation();
  return {t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()};
}

/// Of a <pose> with any of the attributes that it may have since 1.9.
ignition::math::Pose3d poseIn(const XMLElement& element) {
  std::istringstream text(element.GetText() == nullptr ? "" : element.GetText());
  double x = 0.0, y = 0.0, z = 0.0, a = 0.0, b = 0.0, c = 0.0, d = 1.0;
  text >> x >> y >> z >> a >> b >> c;
  if (attributeOf(element, "rotation_format") == "quat_xyzw") {
    text >> d;
    return {x, y, z, d, a, b, c};
  }
  const double unit = element.BoolAttribute("degrees") ? kRadPerDeg : 1.0;
  return {x, y, z, a * unit, b * unit, c * unit};
}

/// Poses, and the version, as 1.7 has them.
void bringDown(XMLElement& sdf) {
  if (attributeOf(sdf, "version") > SDF_PROTOCOL_VERSION) sdf.SetAttribute("version", SDF_PROTOCOL_VERSION);
  forEachBelow(sdf, [](XMLElement& element) {
    if (std::string(element.Value()) != "pose") return;
    if (element.BoolAttribute("degrees") || attributeOf(element, "rotation_format") == "quat_xyzw")
      element.SetText(poseText(poseIn(element)).c_str());
    element.DeleteAttribute("degrees");
    element.DeleteAttribute("rotation_format");
  });
}

/// The full name of the model that `element` is in; empty: a world.
std::string scopeOf(const XMLElement& element) {
  std::string scope;
  for (const tinyxml2::XMLNode* node = element.Parent(); node != nullptr; node = node->Parent()) {
    const XMLElement* model = node->ToElement();
    if (model == nullptr || std::string(model->Value()) != "model") continue;
    scope = attributeOf(*model, "name") + (scope.empty() ? "" : "::" + scope);
  }
  return scope;
}

int depthOf(const XMLElement& element) {
  int depth = 0;
  for (const tinyxml2::XMLNode* node = &element; node != nullptr; node = node->Parent()) ++depth;
  return depth;
}

std::optional<Eigen::Isometry3d> poseOf(const sdf::SemanticPose& pose) {
  ignition::math::Pose3d resolved;
  if (!pose.Resolve(resolved, "__model__").empty()) return std::nullopt;
  return toEigen(resolved);
}

/// Where the link, frame or model of this name stands in `model`, of that full name in `file`; names of what
/// is within others have "::" between them.
std::optional<Eigen::Isometry3d> modelFrom(const SdfFile& file, const sdf::Model& model,
                                           const std::string& scope, const std::string& name) {
  if (const sdf::Link* link = model.LinkByName(name)) return poseOf(link->SemanticPose());
  if (const sdf::Frame* frame = model.FrameByName(name)) return poseOf(frame->SemanticPose());
  const std::size_t end = name.find("::");
  const std::string first = name.substr(0, end);
  std::optional<Eigen::Isometry3d> pose, below = Eigen::Isometry3d::Identity();
  if (const sdf::Model* nested = model.ModelByName(first)) {
    pose = poseOf(nested->SemanticPose());
    if (end != std::string::npos)
      below = modelFrom(file, *nested, scope + "::" + first, name.substr(end + 2));
  }
  for (const SdfFile::Included& one : file.included) {
    if (one.within != scope || one.name != first) continue;
    const sdf::Model& included = *modelOf(one.file->root);
    pose = one.within_from_model;
    if (end != std::string::npos)
      below = modelFrom(*one.file, included, included.Name(), name.substr(end + 2));
  }
  if (!pose || !below) return std::nullopt;
  return *pose * *below;
}

/// Puts frames into the place of includes.
class Includes {
 public:
  Includes(const std::vector<const SdfFile*>& sources, SdfFile& file) : sources_(sources), file_(file) {}

  void replaceIn(XMLElement& sdf) {
    std::vector<XMLElement*> includes;
    forEachBelow(sdf, [&](XMLElement& element) {
      if (std::string(element.Value()) == "include") includes.push_back(&element);
      for (const char* attribute : {"relative_to", "attached_to"}) {
        const std::string name = attributeOf(element, attribute);
        if (name.find("::") != std::string::npos) referenced_.insert(name);
      }
    });
    // As libsdformat 12 tells of them: the innermost first.
    std::stable_sort(includes.begin(), includes.end(),
                     [](const XMLElement* a, const XMLElement* b) { return depthOf(*a) > depthOf(*b); });
    for (XMLElement* include : includes) replace(*include);
  }

 private:
  void replace(XMLElement& include) {
    const std::string token = childText(include, "uri").substr(std::string(kSdfToken).size());
    const SdfFile& source = *sources_.at(std::stoul(token));
    const sdf::Model& model = *modelOf(source.root);
    const std::string name = childText(include, "name");
    XMLElement& parent = *include.Parent()->ToElement();
    file_.included.push_back({scopeOf(include), name, &source, Eigen::Isometry3d::Identity()});

    XMLElement& frame = addFrame(parent, name);
    XMLElement& pose = childIn(frame, "pose");
    ignition::math::Pose3d stands;
    if (const XMLElement* given = include.FirstChildElement("pose")) {
      stands = poseIn(*given);
      if (const char* from = given->Attribute("relative_to")) pose.SetAttribute("relative_to", from);
    }
    const std::string placed = childText(include, "placement_frame");
    const auto placement = modelFrom(source, model, model.Name(), placed);
    if (!placed.empty() && !placement)
      throw std::runtime_error(placeOf(file_.path, include) + ": there is no placement frame " + placed);
    Eigen::Isometry3d parent_from_model = toEigen(stands);
    if (placement) parent_from_model = parent_from_model * placement->inverse();
    pose.SetText(poseText(toIgnition(parent_from_model)).c_str());
    addReferenced(parent, name, source);
    parent.DeleteChild(&include);
  }

  void addReferenced(XMLElement& parent, const std::string& name, const SdfFile& source) {
    const sdf::Model& model = *modelOf(source.root);
    for (const std::string& reference : referenced_) {
      if (reference.compare(0, name.size() + 2, name + "::") != 0) continue;
      const auto pose = modelFrom(source, model, model.Name(), reference.substr(name.size() + 2));
      if (!pose) continue;
      XMLElement& frame = addFrame(parent, reference);
      frame.SetAttribute("attached_to", name.c_str());
      childIn(frame, "pose").SetText(poseText(toIgnition(*pose)).c_str());
    }
  }

  static XMLElement& addFrame(XMLElement& parent, const std::string& name) {
    XMLElement& frame = newChildIn(parent, "frame");
    frame.SetAttribute("name", name.c_str());
    return frame;
  }

  const std::vector<const SdfFile*>& sources_;
  SdfFile& file_;
  std::set<std::string> referenced_;
};

/// The model of this full name; null where there is none.
const sdf::Model* modelNamed(const sdf::Root& root, const std::string& full_name) {
  const sdf::Model* model = nullptr;
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 2) {
    end = full_name.find("::", begin);
    const std::string name = full_name.substr(begin, end == std::string::npos ? end : end - begin);
    const sdf::Model* next = model != nullptr ? model->ModelByName(name) : modelOf(root);
    for (std::uint64_t i = 0; next == nullptr && model == nullptr && i < root.WorldCount(); ++i)
      next = root.WorldByIndex(i)->ModelByName(name);
    model = next;
    if (model == nullptr) return nullptr;
  }
  return model;
}

sdf::Errors stand(const sdf::Root& root, SdfFile::Included* included) {
  ignition::math::Pose3d pose;
  sdf::Errors errors;
  if (included->within.empty()) {
    for (std::uint64_t i = 0; i < root.WorldCount(); ++i) {
      const sdf::Frame* frame = root.WorldByIndex(i)->FrameByName(included->name);
      if (frame != nullptr) errors = frame->SemanticPose().Resolve(pose, "world");
    }
  } else if (const sdf::Model* model = modelNamed(root, included->within)) {
    const sdf::Frame* frame = model->FrameByName(included->name);
    if (frame != nullptr) errors = frame->SemanticPose().Resolve(pose, "__model__");
  }
  included->within_from_model = toEigen(pose);
  return errors;
}

}  // namespace

sdf::Errors loadRoot(tinyxml2::XMLDocument& document, const std::vector<const SdfFile*>& sources,
                     SdfFile& file) {
  XMLElement& sdf = *document.FirstChildElement("sdf");
  bringDown(sdf);
  for (XMLElement* model : childrenOf(sdf, "model")) {
    file.placement_frame = attributeOf(*model, "placement_frame");
    model->DeleteAttribute("placement_frame");
  }
  Includes(sources, file).replaceIn(sdf);
  sdf::Errors errors;
  const sdf::SDFPtr parsed = emptySdfFor(document);
  parsed->Root()->SetFilePath(file.path);  // which its elements inherit
  if (sdf::readString(printed(document), parsed, errors)) {
    const sdf::Errors more = file.root.Load(parsed);
    errors.insert(errors.end(), more.begin(), more.end());
  } else if (errors.empty()) {
    errors.emplace_back(sdf::ErrorCode::STRING_READ, "libsdformat cannot read this file");
  }
  for (SdfFile::Included& one : file.included) {
    if (errors.empty()) errors = stand(file.root, &one);
  }
  return errors;
}

bool standsForIncluded(const std::string& frame) {
  return frame.find("::") != std::string::npos;
}

}  // namespace sunlit::scene
