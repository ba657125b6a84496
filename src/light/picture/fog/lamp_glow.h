/// The glow of lamps in fog.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "light/lamps/lamp_beam.h"
#include "light/picture/fog/fog_scatter.h"
#include "light/picture/sky/pixel_of_direction.h"
#include "light/picture/sky/sky_pixel.h"
#include "sunlit/image/images.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"
#include "sunlit/scene/scene.h"

namespace sunlit::light {

/// Found along the corners of cells of pixels and interpolated, but in tiles about a lamp or along the edge
/// of its cone, where its glow is found for each pixel: within 3 % of looking along each. What hides a lamp
/// from the fog casts its shadow into it, coarsely: by rays along every fourth corner, each of a whole slice,
/// or of its part before what is seen there.
class LampGlow {
 public:
  /// Keeps references to `surfaces` and `visibility`. `lamps` may be null. Casts rays, in parallel.
  LampGlow(const std::vector<scene::Lamp>* lamps, const sky::Fog& fog, const Surfaces& surfaces,
           const Visibility& visibility);

  /// Adds what lies before the tile's samples, and before the sky in it, to its pixels.
  void addTo(const Tile& tile, const SkyPixel& sky, image::LinearImage* image) const;

 private:
  static constexpr int kCell = 8;           ///< px
  static constexpr int kCellsOfShadow = 4;  ///< across one cell of the shadows' corners
  static constexpr int kCellsOfTile = Surfaces::kTileSize / kCell;

  /// Lamps are left out that together would give less than this share of the glow.
  static constexpr float kLeftOut = 0.02f;

  /// Corners of cells, by rows.
  struct Lattice {
    Lattice(const Surfaces& surfaces, int cell_px);
    std::size_t size() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
    float x(std::size_t i) const;
    float y(std::size_t i) const;
    int cell_px, columns, rows;
  };
  /// Four corners about a pixel, and what each counts.
  struct Among {
    std::size_t corners[4];
    float weights[4];
  };
  static Among among(const Lattice& lattice, float x, float y);

  /// Where one looks along one of the shadows' corners, and how far into the fog, m from where it begins.
  struct Sight {
    Eigen::Vector3f towards;
    float end_m;
  };
  void findSights(const Visibility& visibility);
  void findShadows(std::size_t lamp, const Visibility& visibility);
  LampOpen openAt(std::size_t lamp, float x, float y) const;
  void add(std::size_t lamp, float x, float y, GlowProfile* profile) const;
  /// Lamps that shine in the tile or just beside it, or whose cone ends in it.
  std::vector<std::size_t> near(const Tile& tile) const;
  /// Whether a spot's glow is another amid the tile's cells than their corners tell.
  bool endsIn(const Tile& tile, std::size_t lamp) const;
  /// Before a tile.
  class OfTile;

  const Surfaces& surfaces_;
  sky::Fog fog_;
  FogSlices slices_;
  std::vector<LampBeam> beams_;
  std::vector<FogScatter> scatter_;      ///< of each
  std::vector<Eigen::Vector2f> pixels_;  ///< of each, far outside where none is
  Lattice corners_, shadow_corners_;
  std::vector<Sight> sights_;                  ///< at shadow_corners_
  std::vector<std::vector<OpenSlices>> open_;  ///< of each lamp, at shadow_corners_
  std::vector<GlowProfile> profiles_;          ///< at corners_; empty: nothing glows
  std::vector<std::vector<float>> of_spots_;  ///< of each lamp with a cone, at corners_: all its glow, cd/m²
};

}  // namespace sunlit::light
