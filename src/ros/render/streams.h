/// All streams of a camera: for each condition its sky in and its images out, and what all conditions share.
#pragma once

#include <ros/node_handle.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ros/render/condition_output.h"
#include "ros/render/pose_output.h"
#include "ros/render/sky_input.h"
#include "ros/render/studio.h"
#include "sunlit/ros/conditions.h"

namespace sunlit::ros_interface {

/// One place and moment to be photographed.
struct Shot {
  int pose_index = 0;
  ros::Time stamp;
  Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();
  render::BodyPlaces map_from_links = {};  ///< of the robot; empty: it is not there
};

struct StreamOptions {
  PoseOutputOptions pose;
  bool night = true;          ///< moon and stars too
  std::string sun_namespace;  ///< of the topics c/sun, c/moon and c/celestial; empty: the node's own
  WantedSubscribers wanted_subscribers;
};

class Streams {
 public:
  /// `studio` outlives this.
  Streams(const std::vector<Condition>& conditions, const StreamOptions& options, Studio& studio);

  /// Renders the shot under every condition's sky and publishes all of it with its stamp. Only when every sky
  /// is there. Meanwhile draws the geometry of the next shot, if there is one, since drawing leaves cores
  /// idle.
  void take(const Shot& shot, const std::optional<Shot>& next = std::nullopt);
  /// One image of `condition`. Throws std::invalid_argument naming what is wrong with the condition.
  Photograph view(const Shot& shot, const std::string& condition);

  const PoseOutput& poseOutput() const { return pose_output_; }
  /// What is missing before a first image can be taken, in words; empty if nothing is.
  std::string waitsForSky() const;
  /// What is missing before a first image would reach everybody, in words; empty if nothing is.
  std::string waitsForSubscribers() const;

 private:
  struct Stream {
    Stream(const Condition& condition, const StreamOptions& options, const image::PinholeCamera& camera);
    std::string name;
    SkyInput sky;
    ConditionOutput output;
    std::optional<light::Illumination> light;  ///< of the sky's version below
    int light_version = 0;
  };
  /// Made anew only when something in the sky moved.
  const light::Illumination& lightOf(Stream& stream);
  /// Lights and publishes what the studio looks at.
  void expose(const Shot& shot);
  Stream& find(const std::string& condition);

  Studio& studio_;
  std::shared_ptr<const std::vector<sky::Star>> stars_;
  WantedSubscribers wanted_;
  PoseOutput pose_output_;
  std::vector<std::unique_ptr<Stream>> streams_;
};

}  // namespace sunlit::ros_interface
