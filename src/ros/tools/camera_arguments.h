/// Command line options of a camera itself, and how a pose is typed; shared by the tools that take pictures.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "ros/tools/world_arguments.h"
#include "sunlit/render/renderer.h"

namespace sunlit::tools {

/// What must be known in full before a camera can be made.
struct CameraWords {
  int width = 640, height = 480;  ///< px, 16 … 8192
  std::optional<double> fov_deg;  ///< horizontal, 0.1 … 170; without it 90
  int supersampling = 2;          ///< samples per pixel and axis, 1 … 4
  int final_gather = 0;           ///< render::RenderOptions::final_gather

  /// Not validated.
  render::RenderOptions options() const;
  /// Throws std::invalid_argument if the camera can't have what it asks for of a world lit like this.
  void requireSense(const WorldOptions& world) const;
};

/// Help for what takeCamera() takes.
extern const char* const kCameraHelp;

/// Takes --size, --fov, --supersampling and --final-gather. False for an option that is none of these. Throws
/// as reject() does.
bool takeCamera(const std::string& key, const std::string& value, CameraWords* words);

/// Of a camera (x forward, y left, z up) at `eye`, m; yaw counter-clockwise from east, pitch up is positive.
Eigen::Isometry3d mapFromCamera(const Eigen::Vector3d& eye, double yaw_rad, double pitch_rad);
/// The same of X,Y,Z[,YAW[,PITCH]], m and deg.
Eigen::Isometry3d mapFromCamera(std::vector<double> pose);

}  // namespace sunlit::tools
