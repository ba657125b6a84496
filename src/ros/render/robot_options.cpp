#include "ros/render/robot_options.h"

#include <ros/console.h>
#include <ros/names.h>
#include <ros/param.h>

#include <stdexcept>

#include "ros/render/input_log.h"

namespace sunlit::ros_interface {

namespace {

constexpr const char* kAuto = "auto";
/// m; no robot is so large, and degrees in the place of metres mostly are beyond it.
const Range kCameraInBase{-50, 50};

[[noreturn]] void rejectCamera(const ParameterReader& parameters) {
  throw std::invalid_argument("parameter " + parameters.fullName("robot/camera_in_base") +
                              " must be auto, the name of a link, or three numbers " + kCameraInBase.words() +
                              " m: [x, y, z]");
}

void readCamera(const ParameterReader& parameters, RobotOptions* robot) {
  using XmlRpc::XmlRpcValue;
  XmlRpcValue value = parameters.value("robot/camera_in_base");
  if (!value.valid()) return;
  if (value.getType() == XmlRpcValue::TypeString) {
    const std::string word = static_cast<std::string>(value);
    if (word.empty()) rejectCamera(parameters);
    if (word != kAuto) robot->camera_link = word;
    return;
  }
  if (value.getType() != XmlRpcValue::TypeArray || value.size() != 3) rejectCamera(parameters);
  Eigen::Vector3d place;
  for (int i = 0; i < 3; ++i) {
    const bool whole = value[i].getType() == XmlRpcValue::TypeInt;
    if (!whole && value[i].getType() != XmlRpcValue::TypeDouble) rejectCamera(parameters);
    place[i] = whole ? static_cast<int>(value[i]) : static_cast<double>(value[i]);
    if (!kCameraInBase.contains(place[i])) rejectCamera(parameters);
  }
  robot->camera_in_base = place;
}

void checkLink(const scene::Robot& robot, const std::string& link, const std::string& option) {
  if (link.empty() || robot.indexOf(link)) return;
  std::string names;
  for (const scene::RobotLink& known : robot.links) names += (names.empty() ? "" : ", ") + known.name;
  throw std::invalid_argument(option + " is \"" + link + "\", but robot " + robot.name +
                              " has only the links " + names);
}

std::string descriptionOf(const std::string& name) {
  const std::string full_name = ros::names::resolve(name);
  std::string text;
  if (!ros::param::get(full_name, text)) {
    throw std::invalid_argument("robot/description is \"" + name + "\", but the parameter " + full_name +
                                (ros::param::has(full_name) ? " holds no text" : " does not exist"));
  }
  return text;
}

}  // namespace

std::vector<Field> fieldsOf(RobotOptions& robot) {
  return {{"description",
           &robot.description,
           "",
           {},
           "name of a parameter that holds a URDF, such as /robot_description"},
          {"file", &robot.file, "", {}, "or a file: .urdf or .sdf"},
          {"base_frame", &robot.base_frame, "", {}, "the link that is placed; empty: the root"},
          {"camera_in_base",
           OwnForm{kAuto},
           "",
           {},
           "on a path: [x, y, z] in m, each from -50 to 50, or the name of a link"},
          {"joints",
           choiceOf(&robot.joints, {kAuto, "rest", "tf"}),
           "",
           {},
           "auto: by TF with camera/follow: tf, else at rest"},
          {"tf_patience",
           &robot.tf_patience_s,
           "s",
           {0, 60},
           "that a link's transform is waited for before it is drawn at rest"},
          {"tf_prefix", &robot.tf_prefix, "", {}, "of links on TF, as robot_state_publisher's: PREFIX/LINK"}};
}

void readRobotForms(const ParameterReader& parameters, bool follows_tf, RobotOptions* robot) {
  readCamera(parameters, robot);
  robot->joints_by_tf = robot->joints == Joints::kTf || (robot->joints == Joints::kAuto && follows_tf);
  if (!robot->description.empty() && !robot->file.empty()) {
    throw std::invalid_argument("parameters " + parameters.fullName("robot/description") + " and " +
                                parameters.fullName("robot/file") +
                                " are both given, but the robot has one source");
  }
}

std::optional<scene::Robot> loadRobot(const RobotOptions& options, const scene::SearchPath& search_path) {
  if (options.none()) return std::nullopt;
  const bool from_file = !options.file.empty();
  scene::Robot robot = from_file ? scene::loadRobot(options.file, search_path)
                                 : scene::parseUrdf(descriptionOf(options.description),
                                                    ros::names::resolve(options.description), search_path);
  checkLink(robot, options.base_frame, "robot/base_frame");
  checkLink(robot, options.camera_link, "robot/camera_in_base");
  for (const std::string& warning : robot.warnings)
    ROS_LOG(inputLevel(), ROSCONSOLE_DEFAULT_NAME, "Robot %s: %s", robot.name.c_str(), warning.c_str());
  ROS_INFO("Robot %s: %zu links, %zu triangles", robot.name.c_str(), robot.links.size(),
           robot.triangleCount());
  return robot;
}

}  // namespace sunlit::ros_interface
