#include "ros/render/robot_places.h"

#include <ros/console.h>
#include <tf2/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ros/render/input_log.h"
#include "ros/render/tf_lookup.h"
#include "sunlit/image/content_hash.h"

namespace sunlit::ros_interface {

namespace {

/// Of what is to be seen, m above the base frame.
double lowestPoint(const scene::Robot& robot, const std::vector<Eigen::Isometry3d>& base_from_links) {
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    for (const scene::Mesh& mesh : robot.links[i].meshes) {
      for (const Eigen::Vector3f& position : mesh.positions)
        lowest = std::min(lowest, (base_from_links[i] * position.cast<double>()).z());
    }
  }
  return lowest;
}

std::string frameOf(const std::string& link, const std::string& prefix) {
  const std::size_t end = prefix.find_last_not_of('/');
  return end == std::string::npos ? link : prefix.substr(0, end + 1) + "/" + link;
}

/// None where TF does not say, or says nothing that can be used.
std::optional<FoundTransform> lookUpOne(const tf2_ros::Buffer& tf, const std::string& parent,
                                        const std::string& child, const ros::Time& stamp) {
  try {
    return lookUp(tf, parent, child, stamp);
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

std::vector<std::optional<Eigen::Isometry3d>> transformsOf(
    const std::vector<std::optional<FoundTransform>>& found) {
  std::vector<std::optional<Eigen::Isometry3d>> transforms(found.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i]) transforms[i] = found[i]->parent_from_child;
  return transforms;
}

/// The link that carries the camera on a path, if one does.
std::optional<std::size_t> carrierOf(const scene::Robot& robot, const RobotOptions& options,
                                     const CameraFrames& frames) {
  if (options.camera_in_base) return std::nullopt;
  return robot.indexOf(options.camera_link.empty() ? frames.camera : options.camera_link);
}

std::size_t baseOf(const scene::Robot& robot, const RobotOptions& options) {
  return options.base_frame.empty() ? 0 : robot.indexOf(options.base_frame).value();
}

/// Where a camera on a link looks, and what is up for it.
struct Outlook {
  Eigen::Vector3d forward, up;
};

Outlook outlookOf(const scene::RobotLink& link, const Eigen::Isometry3d& base_from_link) {
  const Eigen::Matrix3d& turned = base_from_link.linear();
  if (link.name.find("optical") != std::string::npos) return {turned.col(2), -turned.col(1)};
  return {turned.col(0), turned.col(2)};
}

/// What turns and offsets of links come to by rounding, rad.
constexpr double kRounding_rad = 1e-6;

void warnUnlessLevel(const scene::RobotLink& link, const Outlook& outlook) {
  constexpr double kLevel_rad = 0.1 * kRadPerDeg;
  const double tilt_rad = std::acos(std::clamp(outlook.up.z(), -1.0, 1.0));
  if (tilt_rad < kLevel_rad) return;
  ROS_LOG(
      inputLevel(), ROSCONSOLE_DEFAULT_NAME,
      "The robot's link %s, which carries the camera, is tilted by %.1f deg: on a path the camera is level, "
      "and looks where the link does from above",
      link.name.c_str(), tilt_rad / kRadPerDeg);
}

}  // namespace

Angle cameraYaw(const scene::Robot& robot, const RobotOptions& options, const CameraFrames& frames) {
  const std::optional<std::size_t> carrier = carrierOf(robot, options, frames);
  if (!carrier) return Angle();
  const std::vector<Eigen::Isometry3d> base_from_links = robot.baseFromLinks(baseOf(robot, options));
  const Eigen::Vector3d forward = outlookOf(robot.links[*carrier], base_from_links[*carrier]).forward;
  if (forward.head<2>().norm() < kRounding_rad) return Angle();
  const double yaw_rad = std::atan2(forward.y(), forward.x());
  return Angle::radians(std::abs(yaw_rad) < kRounding_rad ? 0.0 : yaw_rad);
}

RobotPlaces::RobotPlaces(const scene::Robot& robot, const RobotOptions& options, const CameraFrames& frames,
                         std::optional<double> camera_height_m)
    : base_(baseOf(robot, options)),
      frames_(frames),
      joints_by_tf_(options.joints_by_tf),
      patience_(options.tf_patience_s) {
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const scene::RobotLink& link = robot.links[i];
    links_.push_back({frameOf(link.name, options.tf_prefix),
                      link.parent < 0 ? i : static_cast<std::size_t>(link.parent), link.parent_from_link,
                      !link.meshes.empty() || !link.lamps.empty()});
  }
  base_from_rest_ = robot.baseFromLinks(base_);
  if (camera_height_m) placeCamera(robot, options, *camera_height_m);
}

void RobotPlaces::placeCamera(const scene::Robot& robot, const RobotOptions& options,
                              double camera_height_m) {
  /// A wheel that sinks in or hovers by more than this is worth a word.
  constexpr double kUnevenness_m = 0.05;
  const double lowest_m = lowestPoint(robot, base_from_rest_);
  const std::optional<std::size_t> carrier = carrierOf(robot, options, frames_);
  if (options.camera_in_base) {
    camera_in_base_ = *options.camera_in_base;
  } else if (carrier) {
    camera_in_base_ = base_from_rest_[*carrier].translation();
    camera_yaw_ = cameraYaw(robot, options, frames_);
    warnUnlessLevel(robot.links[*carrier], outlookOf(robot.links[*carrier], base_from_rest_[*carrier]));
  } else {
    camera_in_base_ = {0.0, 0.0, lowest_m + camera_height_m};
  }
  const double above_path_m = camera_height_m - camera_in_base_.z() + lowest_m;
  if (std::abs(above_path_m) > kUnevenness_m) {
    ROS_LOG(inputLevel(), ROSCONSOLE_DEFAULT_NAME,
            "The lowest point of robot %s is %.2f m above the path: the camera is %.2f m above the path and "
            "%.2f m above the robot's base",
            robot.name.c_str(), above_path_m, camera_height_m, camera_in_base_.z());
  }
}

/// Links that are not known hang from their parents as at rest.
render::BodyPlaces RobotPlaces::place(
    const Eigen::Isometry3d& map_from_base,
    const std::vector<std::optional<Eigen::Isometry3d>>& map_from_known) const {
  render::BodyPlaces map_from_links(links_.size());
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (map_from_known[i]) {
      map_from_links[i] = *map_from_known[i];
    } else if (i == base_ || links_[i].parent == i) {
      map_from_links[i] = map_from_base * base_from_rest_[i];
    } else {
      map_from_links[i] = map_from_links[links_[i].parent] * links_[i].parent_from_link;
    }
  }
  return map_from_links;
}

RobotPlaces::Joints RobotPlaces::lookUp(const tf2_ros::Buffer& tf, const std::string& frame,
                                        const ros::Time& stamp) const {
  Joints frame_from_links(links_.size());
  for (std::size_t i = 0; i < links_.size(); ++i) {
    frame_from_links[i] = lookUpOne(tf, frame, links_[i].frame, stamp);
  }
  return frame_from_links;
}

render::BodyPlaces RobotPlaces::onPath(const Eigen::Isometry3d& map_from_camera, const Joints& joints) const {
  const Eigen::Isometry3d camera_from_base = Eigen::AngleAxisd(-camera_yaw_.rad(), Eigen::Vector3d::UnitZ()) *
                                             Eigen::Translation3d(-camera_in_base_);
  const Eigen::Isometry3d map_from_base = map_from_camera * camera_from_base;
  std::vector<std::optional<Eigen::Isometry3d>> known(links_.size());
  for (std::size_t i = 0; i < joints.size(); ++i)
    if (joints[i]) known[i] = map_from_base * joints[i]->parent_from_child;
  known[base_] = map_from_base;
  return place(map_from_base, known);
}

void RobotPlaces::count(const Joints& joints) {
  bool stands = false;
  for (std::size_t i = 0; i < links_.size(); ++i)
    if (joints[i] && links_[i].matters && i != base_) stands |= countStanding(&links_[i], joints[i]->stamp);
  auto known = transformsOf(joints);
  known[base_] = Eigen::Isometry3d::Identity();
  countMissing(known);
  lacks_links_ |= stands;
}

bool RobotPlaces::knowsJoints(const tf2_ros::Buffer& tf) {
  auto known = transformsOf(joints(tf));
  known[base_] = Eigen::Isometry3d::Identity();
  return !worthWaiting(known);
}

std::optional<render::BodyPlaces> RobotPlaces::byTf(const tf2_ros::Buffer& tf, const ros::Time& stamp) {
  auto known = transformsOf(lookUp(tf, frames_.map, stamp));
  if (!known[base_]) {
    waits_for_ = "the TF frame " + links_[base_].frame + " of the robot's base";
    return std::nullopt;
  }
  const Eigen::Isometry3d map_from_base = *known[base_];
  if (!joints_by_tf_) known.assign(links_.size(), std::nullopt);
  known[base_] = map_from_base;
  if (joints_by_tf_) {
    if (worthWaiting(known)) return std::nullopt;
    countMissing(known);
  }
  return place(map_from_base, known);
}

/// Whether a link that matters is not known, and has not been waited for long enough.
bool RobotPlaces::worthWaiting(const std::vector<std::optional<Eigen::Isometry3d>>& known) {
  std::string missing;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (links_[i].matters && !known[i] && !links_[i].given_up) missing = links_[i].frame;
  }
  if (missing.empty()) {
    waiting_since_.reset();
    return false;
  }
  if (!waiting_since_) waiting_since_ = Clock::now();
  waits_for_ = "the TF frame " + missing + " of the robot";
  if (Clock::now() - *waiting_since_ < patience_) return true;
  waiting_since_.reset();
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (links_[i].matters && !known[i]) links_[i].given_up = true;
  }
  return false;
}

/// Whether nobody renews it.
bool RobotPlaces::countStanding(Link* link, const ros::Time& stamp) const {
  if (stamp.isZero()) return false;  // static
  const Clock::time_point now = Clock::now();
  if (stamp != link->stamp) {
    link->stamp = stamp;
    link->renewed = now;
    return false;
  }
  if (now - link->renewed <= patience_) return false;
  if (link->standing++ == 0) {
    ROS_WARN(
        "The transform of the robot's link %s on TF is that of %.3f s and has not been renewed for %.1f s: "
        "the link stays where it was",
        link->frame.c_str(), stamp.toSec(), patience_.count());
  }
  return true;
}

void RobotPlaces::countMissing(const std::vector<std::optional<Eigen::Isometry3d>>& known) {
  ++poses_;
  lacks_links_ = false;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (known[i]) links_[i].given_up = false;
    if (!links_[i].matters || known[i]) continue;
    lacks_links_ = true;
    if (links_[i].missed++ == 0) {
      ROS_WARN("No transform of the robot's link %s on TF: it is in rest position", links_[i].frame.c_str());
    }
  }
}

std::string RobotPlaces::print() const {
  image::ContentHash print;
  print.add(joints_by_tf_);
  for (const double number : camera_in_base_) print.add(number);
  if (camera_yaw_ != Angle()) print.add(camera_yaw_.rad());  // other folders keep the print that they have
  for (const Eigen::Isometry3d& base_from_link : base_from_rest_)
    for (Eigen::Index i = 0; i < 16; ++i) print.add(base_from_link.matrix()(i));
  return print.text();
}

std::string RobotPlaces::missingLinks() const {
  const auto counted = [this](const std::string& what, int Link::*count) {
    std::string text;
    for (const Link& link : links_) {
      if (link.*count == 0) continue;
      text += (text.empty() ? what : ", ") + link.frame + " in " + std::to_string(link.*count) + " of " +
              std::to_string(poses_) + " poses";
    }
    return text;
  };
  const std::string resting =
      counted("Links of the robot in rest position for want of a transform on TF: ", &Link::missed);
  const std::string standing =
      counted("Links of the robot whose transform on TF was renewed no more: ", &Link::standing);
  return resting + (resting.empty() || standing.empty() ? "" : "; ") + standing;
}

}  // namespace sunlit::ros_interface
