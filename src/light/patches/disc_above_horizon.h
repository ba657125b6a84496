/// A sun or moon that the horizon cuts.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "sunlit/sky/disc_segment.h"

namespace sunlit::light {

/// The part of a disc above the horizon. A DiscLight's illuminance comes from there alone: rays to what has
/// set would be lost once more on the ground.
class DiscAboveHorizon {
 public:
  /// About the unit vector `towards`, of angular radius `radius_rad` > 0.
  DiscAboveHorizon(const Eigen::Vector3f& towards, double radius_rad)
      : low_(std::clamp(-std::asin(std::clamp(static_cast<double>(towards.z()), -1.0, 1.0)) / radius_rad,
                        -1.0, 1.0)) {}

  /// Where a point of the unit disc, y upwards, lies once the whole disc is pressed into that part, evenly:
  /// equal areas stay equal. Of a disc that has set altogether, its upper edge.
  Eigen::Vector2d place(const Eigen::Vector2d& point) const {
    if (low_ <= -1.0) return point;
    // Areas below a line, whose height is as in discSegment(): the middle's side of it.
    const double below = sky::discSegment(low_);
    const double wanted = below + (1.0 - below) * sky::discSegment(point.y());
    double low = low_, high = 1.0;
    constexpr int kHalvings = 40;  // 1e-12 of the radius
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      (sky::discSegment(middle) < wanted ? low : high) = middle;
    }
    const double width = halfWidth(point.y());
    return {width > 0.0 ? point.x() * halfWidth(high) / width : 0.0, high};
  }

 private:
  static double halfWidth(double y) { return std::sqrt(std::max(1.0 - y * y, 0.0)); }

  double low_;  ///< of the horizon, in radii from the middle
};

}  // namespace sunlit::light
