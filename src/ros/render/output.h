/// What leaves the node, and how.
#pragma once

#include <ros/time.h>

#include <cstdint>
#include <optional>

#include "ros/render/camera_frames.h"
#include "sunlit/image/calibration.h"
#include "sunlit/image/images.h"
#include "sunlit/image/stereo.h"

namespace sunlit::ros_interface {

/// One developed image and what it was taken of.
struct Photograph {
  int pose_index = 0;
  ros::Time stamp;
  double ev100 = 0.0;
  image::Rgb8Image picture;
  std::string exposure_mode = {};              ///< how ev100 was chosen, as the parameter calls it
  std::optional<image::Rgb8Image> right = {};  ///< of a stereo camera, whose left picture is the other
};

/// Of all that leaves the node.
struct OutputOptions {
  image::Calibration camera;
  std::optional<image::RightCamera> right = {};  ///< of a stereo camera
  CameraFrames frames;
  std::uint32_t queue_size = 10;  ///< messages kept for a subscriber that is slow to read
  bool compressed = false;        ///< pictures in PNG
  bool publish_tf = true;
  bool follows_tf = false;  ///< others say on TF where frames.camera is
};

}  // namespace sunlit::ros_interface
