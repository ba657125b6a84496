#include "scene/robot/sdf_robot.h"

#include <map>
#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/Root.hh>
#include <stdexcept>
#include <utility>

#include "scene/robot/link_meshes.h"
#include "scene/sdf_files.h"
#include "scene/sdf_library.h"
#include "scene/sdf_pose.h"
#include "scene/sdf_visuals.h"

namespace sunlit::scene {
namespace {

/// Fills a robot with links.
class RobotLinks {
 public:
  RobotLinks(SdfVisuals& visuals, LinkMeshes& meshes, Robot* robot)
      : visuals_(visuals), meshes_(meshes), robot_(*robot) {}

  /// The model of `file`, whose frame is links[frame], with all that it includes. `scope` is before the names
  /// of its links.
  void append(const SdfFile& file, int frame, const std::string& scope) {
    const sdf::Model& model = *modelOf(file.root);
    frames_[scope] = frame;
    appendModel(model, frame, scope);
    for (const SdfFile::Included& one : file.included) {
      // As "base::arm" is within the base that is the robot itself, whose name is before no link.
      const std::string below = one.within.substr(model.Name().size());
      const std::string within = below.empty() ? scope : scope + below.substr(2) + "::";
      const int index = appendFrame(within + one.name, frames_.at(within), one.within_from_model);
      append(*one.file, index, within + one.name + "::");
    }
  }

 private:
  int appendFrame(const std::string& name, int parent, const Eigen::Isometry3d& parent_from_frame) {
    RobotLink frame;
    frame.name = name;
    frame.parent = parent;
    frame.parent_from_link = parent_from_frame;
    meshes_.begin(robot_.links.size());
    robot_.links.push_back(std::move(frame));
    return static_cast<int>(robot_.links.size()) - 1;
  }

  void appendModel(const sdf::Model& model, int parent, const std::string& scope) {
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      const sdf::Link& link = *model.LinkByIndex(i);
      const std::string name = scope + link.Name();
      appendFrame(name, parent, parentFrom(link, name));
      visuals_.addLink(link, Eigen::Affine3d::Identity(), name);
    }
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
      const sdf::Model& nested = *model.ModelByIndex(i);
      const std::string name = scope + nested.Name();
      const int index = appendFrame(name, parent, parentFrom(nested, name));
      frames_[name + "::"] = index;
      appendModel(nested, index, name + "::");
    }
  }

  SdfVisuals& visuals_;
  LinkMeshes& meshes_;
  Robot& robot_;
  std::map<std::string, int> frames_;  ///< of models, by their scopes
};

}  // namespace

Robot loadSdfRobot(const std::string& file, const ResourceFinder& finder) {
  LinkMeshes meshes(file);
  SdfFiles files(finder, meshes.builder());
  const SdfFile& read = files.read(file);
  if (modelOf(read.root) == nullptr)
    throw std::runtime_error(file + ": a robot is one <model>, and this is none");
  Robot robot;
  robot.name = modelOf(read.root)->Name();
  RobotLink frame;
  frame.name = robot.name;
  meshes.begin(0);
  robot.links.push_back(frame);
  SdfVisuals visuals(file, finder, meshes.builder());
  RobotLinks(visuals, meshes, &robot).append(read, 0, "");
  meshes.finish(&robot);
  return robot;
}

}  // namespace sunlit::scene
