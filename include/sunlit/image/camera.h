/// The pinhole camera model shared by renderer and evaluation.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <utility>
#include <vector>

#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/field.h"

namespace sunlit::image {

/// An ideal pinhole camera without distortion. Pixel (u, v): u right, v down; the centre of the top left
/// pixel is (0, 0), as in OpenCV and sensor_msgs/CameraInfo. Optical frame: z forward, x right, y down.
struct PinholeCamera {
  int width = 640;
  int height = 480;
  double fx = 0.0;  ///< focal lengths
  double fy = 0.0;
  double cx = 0.0;  ///< principal point; (width − 1) / 2 for a centred one
  double cy = 0.0;

  /// Square pixels, centred. `horizontal_fov` across the full image width, in (0°, 180°).
  static PinholeCamera fromFieldOfView(int width, int height, Angle horizontal_fov) {
    const double f = 0.5 * width / std::tan(0.5 * horizontal_fov.rad());
    return {width, height, f, f, 0.5 * (width - 1), 0.5 * (height - 1)};
  }
  /// Point in the optical frame (m, z > 0) to pixel.
  Eigen::Vector2d project(const Eigen::Vector3d& point) const {
    return {fx * point.x() / point.z() + cx, fy * point.y() / point.z() + cy};
  }
  /// Pixel to the point at depth 1 (z = 1 m) in the optical frame.
  Eigen::Vector3d unproject(const Eigen::Vector2d& pixel) const {
    return {(pixel.x() - cx) / fx, (pixel.y() - cy) / fy, 1.0};
  }
};

inline std::vector<Field> fieldsOf(PinholeCamera& camera) {
  return {{"width", &camera.width, "px", {16, 8192}, "of the image"},
          {"height", &camera.height, "px", {16, 8192}, "of the image"},
          {"fx", &camera.fx, "px", Range::above(0, 1e6), "focal length across"},
          {"fy", &camera.fy, "px", Range::above(0, 1e6), "focal length down"},
          {"cx", &camera.cx, "px", {-1e5, 1e5}, "principal point, to the right"},
          {"cy", &camera.cy, "px", {-1e5, 1e5}, "principal point, down"}};
}

/// What people may ask fromFieldOfView() for, kept at `place`. Of a very small one of a very wide picture the
/// focal length may still be refused.
inline Field fieldOfViewRow(Field::Place place) {
  return {"horizontal_fov", std::move(place), "deg", {0.1, 175}, "field of view across the whole width"};
}

}  // namespace sunlit::image
