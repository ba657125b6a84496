/// The slow oracle of a level layer of droplets: one light path after another, backwards from below.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "sky/droplets.h"
#include "sunlit/quantity/angle.h"
#include "traced_paths.h"

namespace sunlit::sky {

class PathTracedLayer : public TracedPaths {
 public:
  PathTracedLayer(double optical_depth, const Eigen::Vector3d& towards_sun, double ground_albedo = 0.0)
      : depth_(optical_depth), towards_sun_(towards_sun), albedo_(ground_albedo) {}

  /// Luminance seen towards `towards` (unit, upwards) of light of 1 lx from the sun, without its disc.
  Estimate luminance(const Eigen::Vector3d& towards, int paths) {
    return meanOf(paths, [&] { return path(towards); });
  }

 private:
  double path(Eigen::Vector3d direction) {
    double height = 0.0;  // in optical depth above the ground
    double weight = 1.0, sum = 0.0;
    for (int event = 0; event < 100000; ++event) {
      height += direction.z() * -std::log(1.0 - uniform());
      if (height >= depth_) return sum;
      if (height <= 0.0) {
        if (albedo_ == 0.0) return sum;
        weight *= albedo_;
        height = 0.0;
        sum += weight / kPi * towards_sun_.z() * std::exp(-depth_ / towards_sun_.z());
        direction = around(Eigen::Vector3d::UnitZ(), std::sqrt(uniform()));
        continue;
      }
      const double phase = dropletPhase(static_cast<float>(direction.dot(towards_sun_)));
      sum += weight * phase * std::exp(-(depth_ - height) / towards_sun_.z());
      direction = around(direction, henyeyGreensteinCosine());
    }
    return sum;
  }

  double henyeyGreensteinCosine() {
    const double g = kDropletAsymmetry;
    const double root = (1.0 - g * g) / (1.0 - g + 2.0 * g * uniform());
    return (1.0 + g * g - root * root) / (2.0 * g);
  }

  double depth_;
  Eigen::Vector3d towards_sun_;
  double albedo_;
};

}  // namespace sunlit::sky
