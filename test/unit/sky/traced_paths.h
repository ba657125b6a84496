/// What tracers of light paths have in common: chance, and the mean of many paths.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "sunlit/quantity/angle.h"

namespace sunlit::sky {

class TracedPaths {
 public:
  struct Estimate {
    double mean, error;  ///< and its standard error
  };

 protected:
  /// Of `paths` calls of value().
  template <typename Value>
  static Estimate meanOf(int paths, const Value& value) {
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < paths; ++i) {
      const double one = value();
      sum += one;
      squares += one * one;
    }
    const double mean = sum / paths;
    return {mean, std::sqrt((squares / paths - mean * mean) / paths)};
  }

  /// 0 … 1
  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  /// A direction at `cos_angle` from `axis`, all round alike.
  Eigen::Vector3d around(const Eigen::Vector3d& axis, double cos_angle) {
    const Eigen::Vector3d side =
        axis.cross(std::abs(axis.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX())
            .normalized();
    const double turn = 2.0 * kPi * uniform();
    const double across = std::sqrt(std::max(0.0, 1.0 - cos_angle * cos_angle));
    return (axis * cos_angle + (side * std::cos(turn) + axis.cross(side) * std::sin(turn)) * across)
        .normalized();
  }

 private:
  std::mt19937_64 random_{20240701};
};

}  // namespace sunlit::sky
