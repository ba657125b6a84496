// Robots in URDF.
#include "fuzz/reader.h"
#include "fuzz/scene_extras.h"
#include "sunlit/scene/robot.h"

namespace sunlit::fuzz {

std::vector<std::string> seeds() {
  return {
      contentOf(SUNLIT_SOURCE_DIR "/test/support/worlds/pole.urdf"),
      "<?xml version='1.0'?>\n<robot name='r'><material name='red'><color rgba='1 0 0 1'/></material>\n"
      "<link name='base'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' "
      "izz='1'/>"
      "</inertial><visual name='v'><origin xyz='1 2 3' rpy='0 0.1 0.2'/><geometry><box size='2 4 "
      "6'/></geometry>"
      "<material name='red'/></visual></link>\n"
      "<link name='arm'><visual><geometry><cylinder radius='0.2' length='1'/></geometry></visual></link>\n"
      "<link name='hand'><visual><geometry><mesh filename='triangle.obj' scale='1 1 2'/></geometry><material "
      "name='m'><texture filename='paint.png'/></material></visual></link>\n"
      "<link name='eye'><visual><geometry><sphere radius='0.1'/></geometry></visual></link>\n"
      "<joint name='j' type='revolute'><parent link='base'/><child link='arm'/><origin xyz='0 0 1' rpy='0 0 "
      "1'/>"
      "<axis xyz='0 1 0'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint>\n"
      "<joint name='k' type='prismatic'><parent link='arm'/><child link='hand'/><axis xyz='1 0 0'/><limit "
      "lower='0.5' upper='1' effort='1' velocity='1'/><mimic joint='j' multiplier='2' "
      "offset='0.1'/></joint>\n"
      "<joint name='f' type='fixed'><parent link='hand'/><child link='eye'/></joint>\n"
      "<gazebo reference='eye'><light name='lamp' type='spot'><pose>0 0 0 0 0 0</pose><diffuse>1 1 1 "
      "1</diffuse>"
      "<attenuation><range>20</range></attenuation><direction>1 0 0</direction><spot><inner_angle>0.2"
      "</inner_angle><outer_angle>0.8</outer_angle><falloff>1</falloff></spot></light><material>Gazebo/Red"
      "</material></gazebo></robot>\n"};
}

void read(const std::string& input) {
  layExtras();
  setContent("./input.urdf", input);
  scene::loadRobot("input.urdf", {});
  requireGood(scene::load("input.urdf", {}));
}

std::string named() {
  return "input.urdf";
}

}  // namespace sunlit::fuzz
