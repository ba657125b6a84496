/// In the place of all that reads SDF, where the build has no libsdformat for it.
#include <tinyxml2.h>

#include <stdexcept>

#include "scene/robot/sdf_robot.h"
#include "scene/robot/urdf_lamps.h"
#include "scene/robot/urdf_looks.h"
#include "scene/sdf_world.h"

namespace sunlit::scene {
namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& others) {
  throw std::runtime_error(file +
                           ": this build of sunlit reads no SDF, as libsdformat was not found when it was "
                           "configured; it reads " +
                           others);
}

}  // namespace

Scene loadSdf(const std::string& file, const ResourceFinder&) {
  refuse(file, "worlds that end in .urdf, .dae, .gltf, .glb or .obj");
}

Robot loadSdfRobot(const std::string& file, const ResourceFinder&) {
  refuse(file, "robots that end in .urdf or .xml");
}

std::map<std::string, std::vector<Lamp>> urdfLamps(const std::string& text, SceneBuilder& builder) {
  tinyxml2::XMLDocument document;
  document.Parse(text.c_str());
  const tinyxml2::XMLElement* const robot = document.FirstChildElement("robot");
  for (const tinyxml2::XMLElement* gazebo = robot == nullptr ? nullptr : robot->FirstChildElement("gazebo");
       gazebo != nullptr; gazebo = gazebo->NextSiblingElement("gazebo")) {
    const char* const link = gazebo->Attribute("reference");
    if (link != nullptr && gazebo->FirstChildElement("light") != nullptr)
      builder.warn("lights of <gazebo> elements are not read by this build, which has no libsdformat", link);
  }
  return {};
}

class UrdfLooks::Reader {};

UrdfLooks::UrdfLooks(const std::string&, const ResourceFinder&, SceneBuilder& builder) : builder_(builder) {}

UrdfLooks::~UrdfLooks() = default;

std::optional<int> UrdfLooks::add(const std::string&, const std::string& place) {
  builder_.warn("materials of <gazebo> elements are not read by this build, which has no libsdformat", place);
  return std::nullopt;
}

void UrdfLooks::put(int material, Mesh& mesh) const {
  mesh.material = material;
}

}  // namespace sunlit::scene
