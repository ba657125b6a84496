#include "ros/tools/camera_arguments.h"

#include <cmath>
#include <stdexcept>

#include "ros/tools/arguments.h"
#include "sunlit/light/final_gather.h"

namespace sunlit::tools {

const char* const kCameraHelp =
    R"(  --size WxH                     px, 16 ... 8192 (default 640x480)
  --fov DEG                      horizontal field of view, 0.1 ... 170 (default 90)
  --supersampling N              samples per pixel and axis, 1 ... 4 (default 2)
  --final-gather N               leaves, twigs, wires and the like look closer at the sky: so many rays to each of
                                 its 175 patches, 0 (as baked) ... 16 (default 0); 2 takes seconds a picture
)";

render::RenderOptions CameraWords::options() const {
  render::RenderOptions options;
  options.camera =
      image::PinholeCamera::fromFieldOfView(width, height, Angle::degrees(fov_deg.value_or(90.0)));
  options.supersampling = supersampling;
  options.final_gather = final_gather;
  return options;
}

void CameraWords::requireSense(const WorldOptions& world) const {
  if (final_gather > 0 && !world.bounced)
    throw std::invalid_argument("--final-gather looks closer where light is baked; leave out --bounced off");
}

bool takeCamera(const std::string& key, const std::string& value, CameraWords* words) {
  if (key == "--size") {
    const std::vector<double> size = numbers(key, value, {2, 2}, 'x');
    for (const double side : size) {
      if (side != std::floor(side) || side < 16 || side > 8192)
        reject(key, value, "WIDTHxHEIGHT, whole numbers of 16 ... 8192 px");
    }
    words->width = static_cast<int>(size[0]);
    words->height = static_cast<int>(size[1]);
  } else if (key == "--fov") {
    words->fov_deg = numberWithin(key, value, 0.1, 170.0);
  } else if (key == "--supersampling") {
    words->supersampling = wholeWithin(key, value, 1, 4);
  } else if (key == "--final-gather") {
    words->final_gather = wholeWithin(key, value, 0, light::FinalGather::kMostRays);
  } else {
    return false;
  }
  return true;
}

Eigen::Isometry3d mapFromCamera(const Eigen::Vector3d& eye, double yaw_rad, double pitch_rad) {
  Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();
  map_from_camera.linear() = (Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
                              Eigen::AngleAxisd(-pitch_rad, Eigen::Vector3d::UnitY()))
                                 .toRotationMatrix();
  map_from_camera.translation() = eye;
  return map_from_camera;
}

Eigen::Isometry3d mapFromCamera(std::vector<double> pose) {
  pose.resize(5, 0.0);
  return mapFromCamera({pose[0], pose[1], pose[2]}, pose[3] * kRadPerDeg, pose[4] * kRadPerDeg);
}

}  // namespace sunlit::tools
