/// The models that SDF files include, each read once.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <sdf/InterfaceModel.hh>
#include <sdf/InterfaceModelPoseGraph.hh>
#include <sdf/Model.hh>
#include <sdf/ParserConfig.hh>
#include <sdf/Root.hh>
#include <string>
#include <vector>

#include "scene/resource_finder.h"

namespace sunlit::scene {

/// libsdformat copies its whole schema for every <include>, 35 ms each. It lets other formats join in by
/// interface models (libsdformat's composition interface): the user of the library reads the included file,
/// libsdformat puts its frames into the tree of poses. Here that is used for SDF models themselves, so that a
/// model included 70 times is read once.
class SdfIncludes {
 public:
  struct Instance {
    std::string name;             ///< in full, with those of the models that it is in
    const sdf::Model* model;      ///< what was included
    ignition::math::Pose3d pose;  ///< of the model's frame in the world
  };

  /// `file` is the SDF file that is loaded.
  SdfIncludes(const std::string& file, const ResourceFinder& finder) : file_(file), finder_(finder) {}

  /// For sdf::Root::Load; afterwards instances() holds what was included. Refers to this object. Loading with
  /// it may fail where plainConfig() does not.
  sdf::ParserConfig sharingConfig();
  /// Leaves the includes to libsdformat.
  sdf::ParserConfig plainConfig();

  const std::string& file() const { return file_; }
  const std::vector<Instance>& instances() const { return instances_; }
  void forgetInstances() { instances_.clear(); }
  /// Addresses that were looked for in vain, and where.
  const std::map<std::string, std::string>& missing() const { return missing_; }

 private:
  std::string find(const std::string& uri);
  /// The root of the model in `folder`; null if there is none, or only libsdformat can tell what is wrong
  /// with it.
  const sdf::Root* modelIn(const std::string& folder);
  sdf::InterfaceModelPtr interfaceOf(const sdf::NestedInclude& include, sdf::Errors& errors);

  std::string file_;
  const ResourceFinder& finder_;
  std::map<std::string, std::unique_ptr<sdf::Root>> roots_;
  std::vector<Instance> instances_;
  std::map<std::string, std::string> missing_;
};

}  // namespace sunlit::scene
