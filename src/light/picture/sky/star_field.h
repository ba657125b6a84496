/// Stars as a camera's pixels see them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "light/picture/sky/disc_in_view.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

/// Each star is spread by a cubic B-spline: what a pixel's square receives through a lens that blurs by a
/// little more than a pixel. Its weights add to 1 wherever the star stands between the pixels, so that no
/// star twinkles as the camera moves.
class StarField {
 public:
  /// What stars add to the mean luminance of a pixel, cd/m², if it sees nothing but sky.
  struct Spot {
    int x, y;
    Eigen::Array3f luminance;
  };

  /// Leaves out stars behind `moon`, and those that the sky outshines ten-thousandfold.
  StarField(const Surfaces& surfaces, const sky::Daylight& day, const DiscInView& moon);

  /// Those within `tile`, several at one pixel where stars overlap.
  const std::vector<Spot>& in(const Tile& tile) const;

 private:
  void add(const Surfaces& surfaces, const Eigen::Vector2d& pixel, const Eigen::Array3f& luminance);

  std::size_t tileAt(int x, int y) const;

  int columns_;                           ///< of tiles
  std::vector<std::vector<Spot>> tiles_;  ///< by tile; empty if there are no stars
  std::vector<Spot> none_;
};

}  // namespace sunlit::light
