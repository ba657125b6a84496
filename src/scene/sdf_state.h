/// The <state> of a world that Gazebo saved: where its models stood then, which is where they are loaded.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <sdf/World.hh>
#include <set>
#include <string>

#include "scene/scene_builder.h"

namespace sunlit::scene {

/// Gazebo classic writes poses of models and links in the world, and a state overrules all else that the file
/// says of where they are. Models and links go by full names, "shelf::board".
class SdfState {
 public:
  /// Of a world without a <state>.
  SdfState() = default;
  /// The first <state> of `world`. What of it is not applied becomes a warning of `builder`. Throws
  /// std::runtime_error naming the model for a pose that is not finite.
  SdfState(const sdf::World& world, SceneBuilder& builder);

  /// Where the model's or link's own frame stands in the world; nothing where the state is silent.
  std::optional<Eigen::Isometry3d> mapFrom(const std::string& full_name) const;
  bool isDeleted(const std::string& model) const { return deleted_.count(model) > 0; }
  /// Models of the state that mapFrom() was never asked for: the world has no such model.
  std::size_t unknownModels() const;

 private:
  void readModel(sdf::Element& model, const std::string& scope, SceneBuilder& builder);

  struct Entry {
    Eigen::Isometry3d map_from_frame;
    bool is_model;
  };
  std::map<std::string, Entry> entries_;
  std::set<std::string> deleted_;
  mutable std::set<std::string> asked_;
};

}  // namespace sunlit::scene
