/// Random directions, more of them where the sky is bright.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sunlit/sky/daylight.h"

namespace sunlit::light {

/// Cells of even density, by elevation (finer near the horizon) and azimuth, each drawn as often as it is
/// bright.
class SkySampler {
 public:
  explicit SkySampler(const sky::Daylight& day);

  /// Unit vector in `map`, from two independent numbers in [0, 1).
  Eigen::Vector3f sample(float first, float second) const;
  /// Probability per solid angle of a direction, 1/sr.
  float density(const Eigen::Vector3f& towards) const;

 private:
  static constexpr int kRows = 96;  ///< half of them above the horizon
  static constexpr int kColumns = 192;

  std::vector<float> up_to_;    ///< probability of all cells up to this one
  std::vector<float> density_;  ///< by cell
};

}  // namespace sunlit::light
