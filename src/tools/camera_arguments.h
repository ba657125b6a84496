/// Command line options of a camera itself, and how a pose is typed; shared by the tools that take pictures.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "sunlit/image/calibration.h"
#include "sunlit/quantity/field.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/render/renderer.h"
#include "sunlit/studio/command_line.h"
#include "sunlit/studio/world.h"

namespace sunlit::tools {

/// What must be known in full before a camera can be made. Stays where it is once addCamera() knows it.
struct CameraWords {
  render::RenderOptions render;  ///< but for what the field of view says of its camera
  double fov_deg = 90.0;
  std::string calibration;  ///< a file; empty: size and field of view say it
  std::vector<image::TypedBeside> typed;

  /// Not validated. Throws what image::readCalibration() and image::requireAgreement() throw.
  render::RenderOptions options() const;
  /// Throws std::invalid_argument if the camera can't have what it asks for of a world baked like this.
  void requireSense(const studio::BakeOptions& bake) const;
};

/// --size, --fov, --calibration, --supersampling, --final-gather and --rasterizer.
void addCamera(studio::CommandLine* line, CameraWords* words);

/// Throws std::invalid_argument for a lens that bends, of a tool whose `purpose` are pinholes.
void requireNoDistortion(const render::RenderOptions& options, const std::string& purpose);

/// Where a camera stands and how it is turned.
struct TypedPose {
  double x = 0.0, y = 0.0, z = 1.0;
  double yaw_deg = 0.0, pitch_deg = 0.0;
};

inline std::vector<Field> fieldsOf(TypedPose& pose) {
  return {{"x", &pose.x, "m", kPoseRange_m, ""},
          {"y", &pose.y, "m", kPoseRange_m, ""},
          {"z", &pose.z, "m", kPoseRange_m, ""},
          {"yaw", &pose.yaw_deg, "deg", {}, "counter-clockwise from east"},
          {"pitch", &pose.pitch_deg, "deg", {-90, 90}, "up is positive"}};
}

/// Of a camera (x forward, y left, z up) at `eye`, m; yaw counter-clockwise from east, pitch up is positive.
Eigen::Isometry3d mapFromCamera(const Eigen::Vector3d& eye, double yaw_rad, double pitch_rad);
Eigen::Isometry3d mapFromCamera(const TypedPose& pose);

}  // namespace sunlit::tools
