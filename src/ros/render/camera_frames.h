/// The TF frames of a camera (REP-105).
#pragma once

#include <string>
#include <vector>

#include "sunlit/quantity/field.h"
#include "sunlit/ros/frame_names.h"

namespace sunlit::ros_interface {

struct CameraFrames {
  std::string map = kMapFrame;                               ///< ENU
  std::string camera = "camera_link";                        ///< x forward, y left, z up
  std::string optical = "camera_optical_frame";              ///< z forward, x right, y down
  std::string right_optical = "camera_right_optical_frame";  ///< likewise, of the right camera
};

std::vector<Field> fieldsOf(CameraFrames& frames);

}  // namespace sunlit::ros_interface
