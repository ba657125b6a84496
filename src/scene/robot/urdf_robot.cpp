#include <urdf_model/model.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "scene/robot/link_meshes.h"
#include "scene/robot/urdf_gazebo.h"
#include "scene/robot/urdf_lamps.h"
#include "scene/robot/urdf_text.h"
#include "scene/robot/urdf_visuals.h"

namespace sunlit::scene {
namespace {

bool hasLimits(const urdf::Joint& joint) {
  return joint.limits && (joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::PRISMATIC);
}

/// rad or m.
double restPosition(const urdf::Joint& joint, const UrdfText& text, std::set<std::string> followers) {
  if (joint.mimic) {
    const auto leader = text.model().joints_.find(joint.mimic->joint_name);
    const bool circular = !followers.insert(joint.name).second;
    if (circular || leader == text.model().joints_.end()) {
      throw std::runtime_error(text.place("joint", joint.name) + ": it mimics " + joint.mimic->joint_name +
                               (circular ? ", which mimics it" : ", which does not exist"));
    }
    return joint.mimic->multiplier * restPosition(*leader->second, text, std::move(followers)) +
           joint.mimic->offset;
  }
  if (!hasLimits(joint)) return 0.0;
  const double lower = joint.limits->lower, upper = joint.limits->upper;
  return lower <= 0.0 && upper >= 0.0 ? 0.0 : 0.5 * (lower + upper);
}

Eigen::Isometry3d parentFromChild(const urdf::Joint& joint, const UrdfText& text) {
  Eigen::Isometry3d transform = toEigen(joint.parent_to_joint_origin_transform);
  const Eigen::Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
  const double position = restPosition(joint, text, {});
  if (joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS) {
    transform.rotate(Eigen::AngleAxisd(position, axis.normalized()));
  } else if (joint.type == urdf::Joint::PRISMATIC) {
    transform.translate(position * axis.normalized());
  }
  return transform;
}

/// Appends `link` and all below it, depth first.
void appendLinks(const urdf::Link& link, int parent, const UrdfText& text, std::vector<RobotLink>* links) {
  RobotLink added;
  added.name = link.name;
  added.parent = parent;
  if (link.parent_joint) added.parent_from_link = parentFromChild(*link.parent_joint, text);
  if (!(added.parent_from_link.matrix().array().abs() <= kFarthest_m).all()) {  // NaN too
    throw std::runtime_error(text.place("joint", link.parent_joint->name) +
                             ": its origin is not finite, or farther than 100 km away");
  }
  const int index = static_cast<int>(links->size());
  links->push_back(std::move(added));
  for (const urdf::LinkSharedPtr& child : link.child_links) appendLinks(*child, index, text, links);
}

/// urdfdom passes over links that several joints hold, though those may go in circles then.
void requireOneJointEach(const UrdfText& text) {
  std::map<std::string, std::string> holders;  // by the link
  for (const auto& [name, joint] : text.model().joints_) {
    const auto [holder, is_first] = holders.emplace(joint->child_link_name, name);
    if (!is_first) {
      throw std::runtime_error(text.place("link", joint->child_link_name) + ": it is the child of joints " +
                               holder->second + " and " + name + ", but must be that of one");
    }
  }
}

/// Links that hang from each other in a circle are none of the root's, of which urdfdom says nothing.
void requireAllReached(const UrdfText& text, const std::vector<RobotLink>& reached) {
  std::set<std::string> names;
  for (const RobotLink& link : reached) names.insert(link.name);
  std::string wrong;
  for (const std::string& link : text.links()) {
    if (names.count(link) > 0) continue;
    wrong += wrong.empty() ? text.place("link", link) + ": no joints lead to it from link " +
                                 reached.front().name + ", the root"
                           : ", nor to link " + link;
  }
  if (!wrong.empty()) throw std::runtime_error(wrong);
}

}  // namespace

Robot parseUrdf(const std::string& text, const std::string& origin, const SearchPath& search_path) {
  const UrdfText urdf_text(text, origin);
  const ResourceFinder finder(search_path, origin);
  Robot robot;
  robot.name = urdf_text.model().getName();
  if (urdf_text.model().getRoot()) {
    requireOneJointEach(urdf_text);
    appendLinks(*urdf_text.model().getRoot(), -1, urdf_text, &robot.links);
    requireAllReached(urdf_text, robot.links);
  }
  LinkMeshes meshes(origin);
  UrdfVisuals visuals(origin, finder, meshes.builder());
  std::map<std::string, GazeboMaterial> of_gazebo = gazeboMaterialsOfLinks(text);
  for (const std::string& oddity : urdf_text.oddities()) {
    const bool told = oddity.find("' undefined.") != std::string::npos;  // of materials, with their visuals
    if (!told) meshes.builder().warn("warnings of urdfdom", oddity);
  }
  for (const std::string& element : urdf_text.unknown())
    meshes.builder().warn("elements of links have a <geometry>, but are unknown, and were left out", element);
  std::map<std::string, std::vector<Lamp>> lamps = urdfLamps(text, meshes.builder());
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const std::string& name = robot.links[i].name;
    meshes.begin(i);
    visuals.add(*urdf_text.model().getLink(name), urdf_text.place("link", name), of_gazebo[name]);
    for (Lamp& lamp : lamps[name]) meshes.builder().addLamp(std::move(lamp));
  }
  meshes.finish(&robot);
  return robot;
}

}  // namespace sunlit::scene
