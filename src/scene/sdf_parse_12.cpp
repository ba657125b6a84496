/// libsdformat 12 lets other formats join in by interface models (its composition interface): the user of the
/// library reads what is included, libsdformat puts its frames into the tree of poses. Here all includes of
/// models go that way.
#include <memory>
#include <sdf/Frame.hh>
#include <sdf/InterfaceElements.hh>
#include <sdf/InterfaceFrame.hh>
#include <sdf/InterfaceLink.hh>
#include <sdf/InterfaceModel.hh>
#include <sdf/InterfaceModelPoseGraph.hh>
#include <sdf/Link.hh>
#include <sdf/ParserConfig.hh>
#include <sdf/World.hh>
#include <sdf/parser.hh>
#include <stdexcept>

#include "scene/sdf_library.h"
#include "scene/sdf_parse.h"
#include "scene/sdf_pose.h"
#include "scene/sdf_schema.h"
#include "scene/sdf_xml.h"

namespace sunlit::scene {
namespace {

ignition::math::Pose3d toIgnition(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.linear());
  const Eigen::Vector3d t = pose.translation();
  return {t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()};
}

/// A model as far as poses may refer to what is in it.
struct Shown {
  std::string name;
  std::string within;  ///< its full name in its own file
  ignition::math::Pose3d pose;
  sdf::RepostureFunction reposture = nullptr;
};

sdf::InterfaceModelPtr interfaceTo(const SdfFile& file, const sdf::Model& model, const Shown& as) {
  auto shown = std::make_shared<sdf::InterfaceModel>(as.name, as.reposture, true, "", as.pose);
  ignition::math::Pose3d pose;
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
    const sdf::Link& link = *model.LinkByIndex(i);
    if (link.SemanticPose().Resolve(pose).empty()) shown->AddLink({link.Name(), pose});
  }
  for (std::uint64_t i = 0; i < model.FrameCount(); ++i) {
    const sdf::Frame& frame = *model.FrameByIndex(i);
    if (frame.SemanticPose().Resolve(pose, "__model__").empty())
      shown->AddFrame({frame.Name(), "__model__", pose});
  }
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
    const sdf::Model& nested = *model.ModelByIndex(i);
    if (!nested.SemanticPose().Resolve(pose).empty()) continue;
    shown->AddNestedModel(interfaceTo(file, nested, {nested.Name(), as.within + "::" + nested.Name(), pose}));
  }
  for (const SdfFile::Included& one : file.included) {
    if (one.within != as.within) continue;
    const sdf::Model& nested = *one.file->root.Model();
    shown->AddNestedModel(
        interfaceTo(*one.file, nested, {one.name, nested.Name(), toIgnition(one.within_from_model)}));
  }
  return shown;
}

/// Where the model of this full name stands in the root of its file.
Eigen::Isometry3d rootFrom(const sdf::Root& root, const std::string& full_name) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const sdf::Model* model = nullptr;
  for (std::size_t begin = 0, end = 0; !full_name.empty() && end != std::string::npos; begin = end + 2) {
    end = full_name.find("::", begin);
    const std::string name = full_name.substr(begin, end == std::string::npos ? end : end - begin);
    if (model != nullptr) {
      model = model->ModelByName(name);
    } else if (root.Model() != nullptr) {
      model = root.Model();
    } else {
      for (std::uint64_t i = 0; model == nullptr && i < root.WorldCount(); ++i)
        model = root.WorldByIndex(i)->ModelByName(name);
    }
    if (model == nullptr) throw std::runtime_error(full_name + ": there is no such model");
    pose = pose * parentFrom(*model, full_name);
  }
  return pose;
}

sdf::InterfaceModelPtr interfaceOf(const sdf::NestedInclude& include,
                                   const std::vector<const SdfFile*>& sources, SdfFile& file) {
  const std::string token = include.Uri().substr(std::string(kSdfToken).size());
  const SdfFile* source = sources.at(std::stoul(token));
  const sdf::Model& model = *source->root.Model();
  const std::string name = include.LocalModelName().value_or(model.Name());
  const std::string within = include.AbsoluteParentName();
  Shown shown{name, model.Name(), model.RawPose()};
  shown.reposture = [&file, name, within, source](const sdf::InterfaceModelPoseGraph& graph) {
    ignition::math::Pose3d pose;  // in the root of the file; loadRoot() makes it that of `within`
    if (graph.ResolveNestedModelFramePoseInWorldFrame(pose).empty())
      file.included.push_back({within, name, source, toEigen(pose)});
  };
  return interfaceTo(*source, model, shown);
}

}  // namespace

sdf::Errors loadRoot(tinyxml2::XMLDocument& document, const std::vector<const SdfFile*>& sources,
                     SdfFile& file) {
  sdf::ParserConfig config;
  config.SetFindCallback([](const std::string& token) { return token; });
  config.RegisterCustomModelParser(
      [&](const sdf::NestedInclude& include, sdf::Errors&) { return interfaceOf(include, sources, file); });
  sdf::Errors errors;
  const sdf::SDFPtr parsed = emptySdfFor(document);
  parsed->Root()->SetFilePath(file.path);  // which its elements inherit
  if (sdf::readString(printed(document), config, parsed, errors)) {
    const sdf::Errors more = file.root.Load(parsed, config);
    errors.insert(errors.end(), more.begin(), more.end());
  } else if (errors.empty()) {
    errors.emplace_back(sdf::ErrorCode::STRING_READ, "libsdformat cannot read this file");
  }
  if (!errors.empty()) return errors;
  if (file.root.Model() != nullptr) file.placement_frame = file.root.Model()->PlacementFrameName();
  for (SdfFile::Included& one : file.included)
    one.within_from_model = rootFrom(file.root, one.within).inverse() * one.within_from_model;
  return errors;
}

bool standsForIncluded(const std::string&) {
  return false;
}

}  // namespace sunlit::scene
