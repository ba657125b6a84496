/// How a real lens bends what a pinhole would show.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sunlit/image/camera.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::image {

/// Models of sensor_msgs/CameraInfo, with their coefficients in its order.
enum class LensModel {
  kPlumbBob,            ///< k1 k2 p1 p2 [k3] (Brown 1966, Conrady 1919)
  kRationalPolynomial,  ///< k1 k2 p1 p2 k3 k4 k5 k6
  kEquidistant,         ///< k1 k2 k3 k4 (Kannala and Brandt 2006, as cv::fisheye has it)
  kOmni                 ///< xi k1 k2 p1 p2 (Mei and Rives 2007, as cv::omnidir has it)
};

/// plumb_bob, rational_polynomial, equidistant, omni: in the order of the enumerators.
std::vector<std::string> lensModelNames();
std::string nameOf(LensModel model);

struct Distortion {
  LensModel model = LensModel::kPlumbBob;
  std::vector<double> coefficients = std::vector<double>(5, 0.0);

  /// Whether a pinhole shows the same.
  bool none() const;
};

/// Throws std::invalid_argument for a number of coefficients that the model does not have, one that is not
/// finite, and an xi below 0; `called` is the key, such as "FILE: distortion_coefficients".
void requireCoefficients(const Distortion& distortion, const std::string& called);

/// Turns pixels into the directions that they look along, and back. All models are one formula: a direction
/// at the angle θ from the axis comes to lie at the distance g(θ) from the middle of a plane (g is tan θ, θ,
/// or sin θ / (cos θ + ξ)), a polynomial moves it there, and focal lengths make pixels of that. Where the
/// polynomial turns round, two directions share a pixel: it is followed up to that fold alone.
class Lens {
 public:
  /// `camera` has focal lengths, middle and size. Throws as requireCoefficients().
  Lens(const PinholeCamera& camera, const Distortion& distortion);

  const PinholeCamera& camera() const { return camera_; }
  const Distortion& distortion() const { return distortion_; }
  /// Models of more than a half-space. Depth is the distance from the camera then, not along the axis.
  bool wide() const { return wide_; }

  /// Of a point in the optical frame, m; nothing beyond fold() or, if not wide(), behind the camera.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point) const;
  /// What a pixel looks along in the optical frame, of depth 1 m: of length 1 if wide(), else with z = 1.
  /// Within 1e-9 px of what project() makes of it; nothing where no direction below fold() comes to lie.
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& pixel) const;

  /// From the axis, up to which directions farther from it lie farther from the middle, but for the small
  /// terms p1 and p2: where the polynomial folds, or where the model ends.
  Angle fold() const { return fold_; }
  /// Of what the picture shows, from the axis. Throws std::invalid_argument naming fold() where its edge lies
  /// beyond that, and where it is more than kWidest.
  Angle widest() const;
  /// Between what its left and its right edge show, at the height of the middle.
  Angle acrossWidth() const;
  static constexpr double kWidest_deg = 124.0;  ///< what five faces of a cube show all around

 private:
  struct Bent {
    Eigen::Vector2d at;
    Eigen::Matrix2d slope;
  };
  double planeRadius(double theta) const;
  Eigen::Vector3d direction(const Eigen::Vector2d& on_plane) const;
  Bent bend(const Eigen::Vector2d& on_plane) const;
  double bentRadius(double plane_radius) const;
  double bentSlope(double plane_radius) const;
  double straightRadius(double bent_radius) const;
  void findFold();

  PinholeCamera camera_;
  Distortion distortion_;
  bool wide_;
  double xi_ = 0.0;
  std::array<double, 4> above_{};  ///< of r², r⁴, r⁶, r⁸
  std::array<double, 3> below_{};
  double p1_ = 0.0, p2_ = 0.0;
  Angle fold_;
  double fold_radius_;  ///< on the plane, may be infinite
};

}  // namespace sunlit::image
