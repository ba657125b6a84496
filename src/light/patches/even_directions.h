/// Directions all around.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <vector>

#include "light/patches/angles.h"

namespace sunlit::light {

/// Unit, evenly over the sphere, by a Fibonacci spiral from the zenith down.
inline std::vector<Eigen::Vector3f> evenDirections(std::size_t count) {
  std::vector<Eigen::Vector3f> all;
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = static_cast<double>(i);
    const double z = 1.0 - (2.0 * number + 1.0) / static_cast<double>(count);
    const double r = std::sqrt(1.0 - z * z), turn = kGoldenAngle * number;
    all.push_back(Eigen::Vector3d(r * std::cos(turn), r * std::sin(turn), z).cast<float>());
  }
  return all;
}

}  // namespace sunlit::light
