#include "scene/sdf_includes.h"

#include <filesystem>
#include <sdf/Frame.hh>
#include <sdf/InterfaceElements.hh>
#include <sdf/InterfaceFrame.hh>
#include <sdf/InterfaceLink.hh>
#include <sdf/Link.hh>
#include <sdf/parser.hh>

namespace sunlit::scene {
namespace {

namespace fs = std::filesystem;

/// Any file that is not SDF by its name makes libsdformat ask us.
constexpr const char* kModelConfig = "model.config";

const ignition::math::Pose3d kNoPose;

/// `model` with its links, frames and nested models, as far as poses may refer to them.
sdf::InterfaceModelPtr interfaceTo(const sdf::Model& model, const std::string& name,
                                   const sdf::RepostureFunction& reposture) {
  auto shown = std::make_shared<sdf::InterfaceModel>(
      name, reposture, model.Static(), model.CanonicalLinkAndRelativeName().second, model.RawPose());
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
    shown->AddNestedModel(interfaceTo(nested, nested.Name(), nullptr));
  }
  return shown;
}

}  // namespace

std::string SdfIncludes::find(const std::string& uri) {
  const Found found = finder_.find(uri, file_);
  if (!found.file) missing_[uri] = placesTried(found);
  return found.file.value_or("");
}

const sdf::Root* SdfIncludes::modelIn(const std::string& folder) {
  const auto known = roots_.find(folder);
  if (known != roots_.end()) return known->second.get();
  auto root = std::make_unique<sdf::Root>();
  const std::string model_file = sdf::getModelFilePath(folder);
  const bool good =
      !model_file.empty() && root->Load(model_file, plainConfig()).empty() && root->Model() != nullptr;
  if (!good) root.reset();
  return (roots_[folder] = std::move(root)).get();
}

sdf::InterfaceModelPtr SdfIncludes::interfaceOf(const sdf::NestedInclude& include, sdf::Errors& errors) {
  const fs::path config = include.ResolvedFileName();
  const sdf::Root* root =
      config.filename() == kModelConfig ? modelIn(config.parent_path().string()) : nullptr;
  // Without a pose of its own an include takes the model's, which libsdformat 12 leaves out for interface
  // models.
  const bool needs_own_pose =
      !include.IncludeRawPose() && root != nullptr && root->Model()->RawPose() != kNoPose;
  if (root == nullptr || needs_own_pose) {
    errors.emplace_back(sdf::ErrorCode::FILE_READ, "cannot share " + include.Uri());
    return nullptr;
  }
  const sdf::Model* model = root->Model();
  const std::string name = include.LocalModelName().value_or(model->Name());
  const std::string parent = include.AbsoluteParentName();
  const std::string full_name = parent.empty() ? name : parent + "::" + name;
  return interfaceTo(*model, name, [this, full_name, model](const sdf::InterfaceModelPoseGraph& graph) {
    ignition::math::Pose3d pose;
    if (graph.ResolveNestedModelFramePoseInWorldFrame(pose).empty())
      instances_.push_back({full_name, model, pose});
  });
}

sdf::ParserConfig SdfIncludes::plainConfig() {
  sdf::ParserConfig config;
  config.SetFindCallback([this](const std::string& uri) { return find(uri); });
  return config;
}

sdf::ParserConfig SdfIncludes::sharingConfig() {
  sdf::ParserConfig config;
  config.SetFindCallback([this](const std::string& uri) {
    const std::string place = find(uri);
    const fs::path model_config = fs::path(place) / kModelConfig;
    std::error_code error;
    const bool is_model =
        !place.empty() && fs::is_regular_file(model_config, error) && modelIn(place) != nullptr;
    return is_model ? model_config.string() : place;
  });
  config.RegisterCustomModelParser([this](const sdf::NestedInclude& include, sdf::Errors& errors) {
    return interfaceOf(include, errors);
  });
  return config;
}

}  // namespace sunlit::scene
