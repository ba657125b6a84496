/// The sky with sun, moon and stars as a camera's pixels see it.
#pragma once

#include <Eigen/Core>
#include <array>

#include "light/picture/sky/disc_in_view.h"
#include "light/picture/sky/star_field.h"
#include "sunlit/image/images.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

class SkyPixel {
 public:
  /// Keeps references.
  SkyPixel(const Surfaces& surfaces, const sky::Daylight& day);

  /// Mean over pixel (x, y) of the sky with sun and moon, cd/m²; without the stars.
  Eigen::Array3f luminance(int x, int y) const;
  /// Adds to the pixels of `tile` what their samples see of the sky, stars included; where it is smooth,
  /// within 0.1 % of luminance().
  void addTo(const Tile& tile, image::LinearImage* image) const;

  /// Of a pixel's samples, those that see the sky; and what of its light that is, by channel.
  static int skySamples(const Tile& tile, int x, int y);
  Eigen::Array3f skyShare(const Tile& tile, int x, int y) const;

 private:
  /// A square of neighbouring pixels.
  struct Cell;
  /// The sky, without sun and moon, at a corner of cells.
  struct Corner {
    Eigen::Array3f luminance;
    float height;  ///< of the direction: its sine
    bool known = false;
  };
  static constexpr int kCell = 4;  ///< px
  static constexpr int kCorners = Surfaces::kTileSize / kCell + 1;
  using Corners = std::array<std::array<Corner, kCorners>, kCorners>;  ///< of a tile, by row and column

  void addCell(const Cell& cell, Corners* corners, image::LinearImage* image) const;
  /// Whether the sky in a cell is as between its corners.
  bool smooth(const Cell& cell, Corners* corners) const;

  const Surfaces& surfaces_;
  sky::Daylight daylight_;  ///< seen from the camera
  DiscInView sun_, moon_;
  StarField stars_;
};

}  // namespace sunlit::light
