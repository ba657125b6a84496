/// Where the links of the robot stand when a picture is taken.
#pragma once

#include <ros/time.h>
#include <tf2_ros/buffer.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "ros/render/camera_frames.h"
#include "ros/render/robot_options.h"
#include "ros/render/tf_lookup.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/render/renderer.h"
#include "sunlit/scene/robot.h"

namespace sunlit::ros_interface {

/// How far to the left of the robot's own x axis the camera looks on a path: as the link that carries it, a
/// camera_link (x forward) or, where "optical" is in its name, an optical frame (z forward; REP-103). 0 where
/// the place of the camera is given in numbers, no link carries it, or that looks straight up or down.
Angle cameraYaw(const scene::Robot& robot, const RobotOptions& options, const CameraFrames& frames);

/// On a path the robot moves with the camera, level as it is, and the joints rest, or move as TF says. After
/// a TF frame it stands where TF says. A link whose transform does not come stays in rest position relative
/// to its parent, and one whose transform is renewed no more where it was; that is said once and counted.
class RobotPlaces {
 public:
  /// `camera_height_m`: of the camera above the path; nothing where there is no path. Without a
  /// camera_in_base the camera is on the link frames.camera, if there is one; else above the base, so that
  /// the robot's lowest point is on the path. The camera stands there turned by cameraYaw(), and level: a
  /// link that is not is told of.
  RobotPlaces(const scene::Robot& robot, const RobotOptions& options, const CameraFrames& frames,
              std::optional<double> camera_height_m);

  /// base_from_link of each link that TF knows; empty: joints rest.
  using Joints = std::vector<std::optional<FoundTransform>>;
  /// The latest.
  Joints joints(const tf2_ros::Buffer& tf) const { return lookUp(tf, links_[base_].frame, ros::Time(0)); }
  /// map_from_link of each link for a camera on a path.
  render::BodyPlaces onPath(const Eigen::Isometry3d& map_from_camera, const Joints& joints) const;
  /// Counts, and says once, which of them a pose lacks that is rendered.
  void count(const Joints& joints);
  /// Whether all links that are to be seen were heard of, or waited for long enough.
  bool knowsJoints(const tf2_ros::Buffer& tf);
  /// By TF at `stamp`; zero: the latest. None while a transform is worth waiting for; see waitsFor().
  std::optional<render::BodyPlaces> byTf(const tf2_ros::Buffer& tf, const ros::Time& stamp);

  /// Differs where links hang otherwise from their base, or the camera stands elsewhere on it.
  std::string print() const;
  std::string waitsFor() const { return waits_for_; }
  /// Which links had no transform in how many poses, or an old one, in one line; empty if there is none.
  std::string missingLinks() const;
  /// Whether the latest pose had one of them.
  bool lacksLinks() const { return lacks_links_; }
  /// How long a link's transform is waited for.
  std::chrono::duration<double> patience() const { return patience_; }
  bool jointsByTf() const { return joints_by_tf_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Link {
    std::string frame;   ///< as TF calls it
    std::size_t parent;  ///< the link's own index for the root
    Eigen::Isometry3d parent_from_link;
    bool matters;           // it is drawn, or lights
    bool given_up = false;  ///< nobody waits for its transform any more
    int missed = 0;         ///< poses without its transform
    ros::Time stamp{};      ///< of its latest transform
    Clock::time_point renewed{};
    int standing = 0;  ///< poses with a transform that nobody renews
  };

  void placeCamera(const scene::Robot& robot, const RobotOptions& options, double camera_height_m);
  render::BodyPlaces place(const Eigen::Isometry3d& map_from_base,
                           const std::vector<std::optional<Eigen::Isometry3d>>& map_from_known) const;
  bool worthWaiting(const std::vector<std::optional<Eigen::Isometry3d>>& known);
  Joints lookUp(const tf2_ros::Buffer& tf, const std::string& frame, const ros::Time& stamp) const;
  bool countStanding(Link* link, const ros::Time& stamp) const;
  void countMissing(const std::vector<std::optional<Eigen::Isometry3d>>& known);

  std::vector<Link> links_;
  std::vector<Eigen::Isometry3d> base_from_rest_;  ///< base_from_link in rest position
  std::size_t base_;
  CameraFrames frames_;
  Eigen::Vector3d camera_in_base_ = Eigen::Vector3d::Zero();
  Angle camera_yaw_;  ///< from the base to the camera
  bool joints_by_tf_;
  std::chrono::duration<double> patience_;
  std::optional<Clock::time_point> waiting_since_;
  int poses_ = 0;  ///< by TF
  bool lacks_links_ = false;
  std::string waits_for_;
};

}  // namespace sunlit::ros_interface
