/// The <state> of a world that Gazebo saved: where its models stood then, which is where they are loaded.
#pragma once

#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace sunlit::scene {

/// Takes the <state> elements out of the worlds in `sdf`, and gives the first one, in a document of its own,
/// or null where there is none. What its <insertions> add becomes part of its world.
std::unique_ptr<tinyxml2::XMLDocument> takeState(tinyxml2::XMLElement& sdf);

/// Gazebo classic writes poses of models, links and lights in the world, and a state overrules all else that
/// the file says of where they are. Models, links and lights go by full names, "shelf::board".
class SdfState {
 public:
  /// Of a world without a <state>.
  SdfState() = default;
  /// The <state> element of `document`, which is that of `file`. Throws std::runtime_error naming file and
  /// model for a pose or scale that is no row of finite numbers.
  SdfState(const tinyxml2::XMLDocument& document, const std::string& file);

  /// Where the own frame of the model, link or light stands in the world; nothing where the state is silent.
  std::optional<Eigen::Isometry3d> mapFrom(const std::string& full_name) const;
  /// How much larger than in its file a model is, along its own axes; links move apart with it.
  Eigen::Vector3d scaleOf(const std::string& model) const;
  bool isDeleted(const std::string& model) const { return deleted_.count(model) > 0; }
  /// Models of the state that mapFrom() was never asked for: the world has no such model.
  std::vector<std::string> unknownModels() const;

 private:
  void readModel(const tinyxml2::XMLElement& model, const std::string& scope);

  struct Entry {
    Eigen::Isometry3d map_from_frame;
    bool is_model;
  };
  std::string file_;
  std::map<std::string, Entry> entries_;
  std::map<std::string, Eigen::Vector3d> scales_;
  std::set<std::string> deleted_;
  mutable std::set<std::string> asked_;
};

}  // namespace sunlit::scene
