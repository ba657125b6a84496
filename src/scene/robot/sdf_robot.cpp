#include "scene/robot/sdf_robot.h"

#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/Root.hh>
#include <stdexcept>

#include "scene/robot/link_meshes.h"
#include "scene/sdf_file.h"
#include "scene/sdf_includes.h"
#include "scene/sdf_pose.h"
#include "scene/sdf_visuals.h"

namespace sunlit::scene {
namespace {

/// What is filled with links.
struct Target {
  SdfVisuals& visuals;
  LinkMeshes& meshes;
  Robot* robot;
};

/// Links of `model`, whose frame is links[parent], and of the models within it.
void appendLinks(const sdf::Model& model, int parent, const std::string& scope, const Target& target) {
  const auto& [visuals, meshes, robot] = target;
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
    const sdf::Link& link = *model.LinkByIndex(i);
    RobotLink added;
    added.name = scope + link.Name();
    added.parent = parent;
    added.parent_from_link = parentFrom(link, added.name);
    meshes.begin(robot->links.size());
    visuals.addLink(link, Eigen::Isometry3d::Identity(), added.name);
    robot->links.push_back(std::move(added));
  }
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
    const sdf::Model& nested = *model.ModelByIndex(i);
    RobotLink frame;
    frame.name = scope + nested.Name();
    frame.parent = parent;
    frame.parent_from_link = parentFrom(nested, frame.name);
    const int index = static_cast<int>(robot->links.size());
    meshes.begin(robot->links.size());
    robot->links.push_back(frame);
    appendLinks(nested, index, frame.name + "::", target);
  }
}

}  // namespace

Robot loadSdfRobot(const std::string& file, const ResourceFinder& finder) {
  SdfIncludes includes(file, finder);
  LinkMeshes meshes(file);
  sdf::Root root;
  readSdf(includes, SdfSharing::kPlain, root, meshes.builder());
  if (root.Model() == nullptr) throw std::runtime_error(file + ": a robot is one <model>, and this is none");
  Robot robot;
  robot.name = root.Model()->Name();
  RobotLink frame;
  frame.name = robot.name;
  meshes.begin(0);
  robot.links.push_back(frame);
  SdfVisuals visuals(file, finder, meshes.builder());
  appendLinks(*root.Model(), 0, "", {visuals, meshes, &robot});
  meshes.finish(&robot);
  return robot;
}

}  // namespace sunlit::scene
