/// A camera at a place.
#pragma once

#include <Eigen/Geometry>
#include <memory>

#include "sunlit/image/camera.h"

namespace sunlit::render {

class LensCanvas;

struct View {
  image::PinholeCamera camera;
  std::shared_ptr<const LensCanvas> lens;  ///< by which it looks; null: a pinhole
  int supersampling = 1;
  double near_m = 0.05, far_m = 20000.0;
  Eigen::Isometry3d map_from_optical = Eigen::Isometry3d::Identity();

  Eigen::Vector3d eye() const { return map_from_optical.translation(); }
  /// What pixel (u, v) looks along in `map`; of depth 1 m, so times a depth plus eye() is a point.
  Eigen::Vector3d ray(double u, double v) const {
    return map_from_optical.linear() * (lens ? throughLens(u, v) : camera.unproject({u, v}));
  }
  /// From one pixel to the next along a row or column, at depth 1 m; of a lens, about its axis.
  Eigen::Vector3d pixelRight() const;
  Eigen::Vector3d pixelDown() const;
  /// Pixel coordinate of sample `i` of a row or column of samples.
  double pixelOfSample(int i) const { return (i + 0.5) / supersampling - 0.5; }

 private:
  Eigen::Vector3d aboutAxis(const Eigen::Vector2d& step_px) const;
  Eigen::Vector3d throughLens(double u, double v) const;
};

}  // namespace sunlit::render
