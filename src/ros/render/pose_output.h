/// What leaves the node once per pose, whatever the number of conditions.
#pragma once

#include <ros/node_handle.h>

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "ros/frame_watch.h"
#include "ros/render/camera_output.h"
#include "ros/render/optical_frame.h"
#include "ros/render/options.h"
#include "ros/render/output.h"
#include "ros/render/path_source.h"
#include "sunlit/image/images.h"

namespace sunlit::ros_interface {

/// Publishes camera/depth/image_raw and camera_info, camera/pose, path and progress; and on TF, where the
/// camera's frame is this node's own, that and the optical frames.
class PoseOutput {
 public:
  PoseOutput(ros::NodeHandle node, ros::NodeHandle private_node, const OutputOptions& options);

  void publishPath(const PathSource& path, const ros::Time& start, double frame_rate) const;
  void publish(const Eigen::Isometry3d& map_from_camera, const image::DepthImage& depth,
               const ros::Time& stamp) const;
  /// Poses since the first of the run that this node is done with: all before the next one that it publishes.
  void publishProgress(int poses) const;
  /// The first topic with too few subscribers; empty if there is none.
  std::string lonelyTopic(const WantedSubscribers& wanted) const;

 private:
  OutputOptions options_;
  CameraOutput depth_;
  HeardTopic pose_;
  ros::Publisher path_;
  ros::Publisher progress_;
  std::optional<HeardTopic> tf_;
  std::optional<OpticalFrames> optical_;
  std::optional<FrameWatch> watch_;
};

}  // namespace sunlit::ros_interface
