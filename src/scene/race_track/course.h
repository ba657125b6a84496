/// Where the track runs: its centre line, and places given by distance along it and sideways from it.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace sunlit::scene::race_track {

/// Half the width of the asphalt, m.
constexpr double kHalfWidth = 4.5;

/// A place by the track: `along` m from the start line in driving direction (cyclic), `left` m to the left of
/// the centre line (negative: right).
struct TrackPlace {
  double along = 0.0;
  double left = 0.0;
};

/// The closed centre line in plan view, a uniform cubic B-spline, so that its curvature is continuous.
class Course {
 public:
  Course();

  /// m.
  double length() const { return length_; }
  Eigen::Vector2d point(const TrackPlace& place) const;
  /// Unit vector of driving there.
  Eigen::Vector2d tangent(double along) const;
  /// 1/m, positive in left turns.
  double curvature(double along) const;
  /// The place of a point of `map`: that of the nearest point of the centre line.
  TrackPlace nearest(const Eigen::Vector2d& point) const;
  /// How far to the left of the centre line a good driver keeps, m.
  double drivingLine(double along) const;

 private:
  struct Sample {
    Eigen::Vector2d point;
    Eigen::Vector2d tangent;
  };
  Sample sample(double along) const;

  std::vector<Sample> samples_;  // equally spaced along the line, closed
  double spacing_ = 0.0;
  double length_ = 0.0;
};

/// The course of the built-in world.
const Course& course();

/// Unit vector to the left of `tangent`.
inline Eigen::Vector2d leftOf(const Eigen::Vector2d& tangent) {
  return {-tangent.y(), tangent.x()};
}

}  // namespace sunlit::scene::race_track
