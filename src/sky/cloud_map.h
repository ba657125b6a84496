/// A layer of broken cloud, seen from above.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "cell_means.h"
#include "sunlit/sky/weather.h"

namespace sunlit::sky {

/// Optical depth of the cloud over each place of a square that repeats itself. Fractal value noise of hashed
/// whole numbers, so that the same seed gives the same bits everywhere; its highest values are cloud, so many
/// that exactly so many oktas of the cells are covered. Of the cloudy cells as many have any depth as any
/// other, from 0 at the edge to twice the mean, which is the optical depth asked for.
class CloudMap {
 public:
  static constexpr int kSide = CellMeans::kSide;

  /// `cover_oktas` above 0 and below 8; 0.3 s of processor time.
  CloudMap(double cover_oktas, double optical_depth, std::uint32_t seed);

  /// Mean of about `width_m` around a place, m from a corner of the square, in any of its repetitions.
  float opticalDepth(const Eigen::Vector2d& place_m, float width_m) const {
    return depths_.around(place_m, width_m);
  }
  /// What comes straight through each cell at a cosine from the vertical.
  CellMeans passed(double cosine) const;
  double coveredShare() const { return covered_share_; }
  /// Of the cloudy cells, the depth below which the part `share` of them is.
  double depthAt(double share) const { return thickest_ * share; }
  /// Mean over all cells of what comes straight through at a cosine from the vertical.
  double meanPassed(double cosine) const;
  /// Of each cell, row by row.
  const std::vector<float>& cells() const { return depths_.cells(); }

 private:
  double covered_share_, thickest_;
  CellMeans depths_;
};

/// Those that were asked for last. For many threads.
class CloudMaps {
 public:
  std::shared_ptr<const CloudMap> of(const Weather& weather);

 private:
  struct Kept {
    double cover_oktas, optical_depth;
    int seed;
    std::shared_ptr<const CloudMap> map;
  };
  std::mutex mutex_;
  std::vector<Kept> kept_;
};

}  // namespace sunlit::sky
