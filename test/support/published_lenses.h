/// Calibrations that were published with well-known data sets and cameras.
#pragma once

#include <string>
#include <vector>

#include "sunlit/image/lens.h"

namespace sunlit {

struct PublishedLens {
  std::string name;
  image::PinholeCamera camera;
  image::Distortion distortion;

  image::Lens lens() const { return image::Lens(camera, distortion); }
};

/// EuRoC MAV, cam0 of its sensor.yaml.
inline PublishedLens eurocLens() {
  return {"EuRoC",
          {752, 480, 458.654, 457.296, 367.215, 248.375},
          {image::LensModel::kPlumbBob, {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05}}};
}

/// KITTI raw, 2011_09_26, S_00, K_00 and D_00 of calib_cam_to_cam.txt.
inline PublishedLens kittiLens() {
  return {"KITTI",
          {1392, 512, 984.2439, 980.8141, 690.0, 233.1966},
          {image::LensModel::kPlumbBob, {-0.3728755, 0.2037299, 0.002219027, 0.001383707, -0.07233722}}};
}

/// TUM RGB-D, freiburg1, colour.
inline PublishedLens tumLens() {
  return {"TUM fr1",
          {640, 480, 517.306408, 516.469215, 318.643040, 255.313989},
          {image::LensModel::kPlumbBob, {0.262383, -0.953104, -0.005358, 0.002628, 1.163314}}};
}

/// TUM-VI, cam0 at 512 x 512.
inline PublishedLens tumViLens() {
  return {"TUM-VI",
          {512, 512, 190.97847715128717, 190.9733070521226, 254.93170605935475, 256.8974428996504},
          {image::LensModel::kEquidistant,
           {0.0034823894022493434, 0.0007150348452162257, -0.0020532361418706202, 0.00020293673591811182}}};
}

/// Intel RealSense T265, left, as ORB-SLAM3's examples have it.
inline PublishedLens t265Lens() {
  return {"T265",
          {848, 800, 284.9501953125, 285.115295410156, 420.500213623047, 400.738098144531},
          {image::LensModel::kEquidistant,
           {-0.00530046410858631, 0.0423333682119846, -0.03949448466300965, 0.006823882460594177}}};
}

/// Intel RealSense D435i, infrared: rectified, so that nothing bends.
inline PublishedLens d435iLens() {
  return {"D435i", {640, 480, 382.613, 382.613, 320.183, 236.455}, {}};
}

/// No published one: eight coefficients of the size that cameras of phones and Azure Kinect have.
inline PublishedLens rationalLens() {
  return {"rational",
          {1280, 720, 607.3, 607.1, 638.2, 366.9},
          {image::LensModel::kRationalPolynomial,
           {0.5127, -2.6133, 0.00062, -0.00021, 1.5044, 0.3932, -2.4391, 1.4309}}};
}

/// No published one: of the size that calibrators find for a lens of 190 degrees.
inline PublishedLens omniLens() {
  return {"omni",
          {752, 480, 460.0, 459.2, 370.1, 246.9},
          {image::LensModel::kOmni, {1.25, -0.21, 0.12, 0.0004, -0.0003}}};
}

inline std::vector<PublishedLens> publishedLenses() {
  return {eurocLens(), kittiLens(), tumLens(),      tumViLens(),
          t265Lens(),  d435iLens(), rationalLens(), omniLens()};
}

}  // namespace sunlit
