/// Angles that cannot be mixed up: a plain angle, and a compass azimuth.
#pragma once

#include <cmath>

namespace sunlit {

constexpr double kPi = 3.14159265358979323846;
constexpr float kPiFloat = static_cast<float>(kPi);
constexpr double kRadPerDeg = kPi / 180.0;

/// A plain angle of any size and sign. The unit is named where one is made or read.
class Angle {
 public:
  constexpr Angle() = default;
  static constexpr Angle radians(double value) { return Angle(value); }
  static constexpr Angle degrees(double value) { return Angle(value * kRadPerDeg); }

  constexpr double rad() const { return rad_; }
  constexpr double deg() const { return rad_ / kRadPerDeg; }

  constexpr Angle operator-() const { return Angle(-rad_); }
  constexpr Angle operator+(Angle other) const { return Angle(rad_ + other.rad_); }
  constexpr Angle operator-(Angle other) const { return Angle(rad_ - other.rad_); }
  constexpr Angle operator*(double factor) const { return Angle(rad_ * factor); }
  constexpr Angle operator/(double divisor) const { return Angle(rad_ / divisor); }
  constexpr bool operator==(Angle other) const { return rad_ == other.rad_; }
  constexpr bool operator!=(Angle other) const { return rad_ != other.rad_; }
  constexpr bool operator<(Angle other) const { return rad_ < other.rad_; }
  constexpr bool operator>(Angle other) const { return rad_ > other.rad_; }
  constexpr bool operator<=(Angle other) const { return rad_ <= other.rad_; }
  constexpr bool operator>=(Angle other) const { return rad_ >= other.rad_; }

 private:
  explicit constexpr Angle(double rad) : rad_(rad) {}
  double rad_ = 0.0;
};

inline double sin(Angle angle) {
  return std::sin(angle.rad());
}
inline double cos(Angle angle) {
  return std::cos(angle.rad());
}
inline double tan(Angle angle) {
  return std::tan(angle.rad());
}

/// Compass azimuth: clockwise from true north as seen from above, in [0, 2π).
/// Not a ROS yaw, which runs counter-clockwise from east; see Direction for vectors in `map`.
class Azimuth {
 public:
  constexpr Azimuth() = default;
  /// Any finite angle; brought into [0, 2π).
  explicit Azimuth(Angle clockwise_from_north) : rad_(wrapped(clockwise_from_north.rad())) {}
  static Azimuth degrees(double value) { return Azimuth(Angle::degrees(value)); }

  constexpr double rad() const { return rad_; }
  constexpr double deg() const { return rad_ / kRadPerDeg; }
  constexpr Angle angle() const { return Angle::radians(rad_); }

 private:
  static double wrapped(double rad) {
    const double turn = 2.0 * kPi;
    const double in_turn = rad - turn * std::floor(rad / turn);
    return in_turn < turn ? in_turn : 0.0;  // rounding may carry a tiny negative angle up to a whole turn
  }
  double rad_ = 0.0;
};

}  // namespace sunlit
