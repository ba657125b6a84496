/// TF frame names that all nodes share (REP-105).
#pragma once

namespace sunlit::ros_interface {

constexpr const char* kMapFrame = "map";                       ///< ENU
constexpr const char* kCameraFrame = "camera_link";            ///< x forward, y left, z up
constexpr const char* kOpticalFrame = "camera_optical_frame";  ///< z forward, x right, y down

}  // namespace sunlit::ros_interface
