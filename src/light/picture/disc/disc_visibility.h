/// How much of a distant disc, the sun or the moon, each surface of a picture sees.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "light/picture/disc/disc_points.h"
#include "light/picture/disc/disc_way.h"
#include "light/picture/disc/pixel_map.h"
#include "light/picture/disc/share_windows.h"
#include "light/picture/table/light_table.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

class DiscVisibility {
 public:
  /// What the disc may shine on.
  struct Picture {
    const Surfaces& surfaces;
    const LightTable& table;  ///< of `surfaces`
  };
  /// A disc as surfaces see it.
  struct Seen {
    bool shines;  ///< false: no rays are cast
    Eigen::Vector3f towards;
    float radius_rad;
    DiscPoints points;
    std::shared_ptr<const DiscWay> way;
    /// Of each tile's surfaces: whether it may shine on them at all; empty: on all.
    std::vector<std::vector<bool>> wanted = {};
  };
  /// Straight; it shines unless it gives less than `least_lx` on a plane facing it. Keeps a reference.
  static Seen straight(const sky::DiscLight& disc, float least_lx, const Visibility& visibility);
  /// Casts all rays, in parallel. Keeps what `picture` refers to.
  DiscVisibility(Seen disc, const Picture& picture);

  const Eigen::Vector3f& towards() const { return disc_.towards; }
  float radius_rad() const { return disc_.radius_rad; }

  /// For each surface of Surfaces::tiles[tile] the share of the disc, 0 … 1, that is not hidden, averaged
  /// over its samples; also behind a thin sheet that light shines through. 0 where the surface is turned
  /// away. Empty where the disc gives too little.
  const std::vector<float>& visibleShares(std::size_t tile) const { return shares_[tile]; }
  /// How many rays that took, without those that surfaces hide themselves.
  std::size_t raysCast() const { return rays_cast_; }

 private:
  /// What the rays of one surface met, and what the later steps need to know of it: surfaces are large, and
  /// going through all of them again takes as long as their rays.
  struct Tally {
    std::uint8_t x, y;  ///< of its pixel, in the tile
    std::uint8_t cast = 0, lit = 0;
    std::uint8_t enough;   ///< mixed ones among 3 × 3 pixels for a penumbra; kNever: gets no more rays
    bool fills;            ///< alone in its pixel, and not foliage
    bool waits = false;    ///< had no probe: first its neighbours are asked
    bool settled = false;  ///< they knew
    bool mixed() const { return lit > 0 && lit < cast; }
    static constexpr std::uint8_t kNever = 255;
  };
  /// Each step casts more rays, where those of the step before found an edge.
  enum class Step {
    kProbe,   ///< one ray a surface, or in every second pixel where one solid surface fills pixels
    kSample,  ///< a quad of points where it fills a pixel, else as many as it has samples, where probes
              ///< within two pixels met both light and dark, or in deep shade with gaps
    kRefine,  ///< all points of the disc, in penumbrae, where neighbours tell nothing
  };

  /// Of all pixels, where the disc shines.
  PixelMap mapOfPixels() const;
  void castAll();
  void probe(std::size_t tile);
  void sample(std::size_t tile);
  /// Samples also what neighbours had settled, where the next pixels were found to lie in a penumbra: it
  /// might be that of a wire.
  void follow(std::size_t tile);
  void refine(std::size_t tile);
  /// Whether light was met all around a block of 4 × 4 pixels, in column x and row y of such blocks.
  bool hasGapsAround(int x, int y) const;
  /// Tells neighbours what was met in a pixel that one solid surface fills.
  void note(const Tile& tile, const Tally& tally);
  bool facesDisc(const LightTable::DiscTarget& target) const;
  bool fillsPixel(const LightTable::DiscTarget& target) const;
  /// Tally::enough, by Tally::fills.
  static std::uint8_t enoughMixed(const LightTable::DiscTarget& target, bool fills);
  /// Rays of surface `index` of a tile that it has not had yet.
  void appendRays(std::size_t tile, std::uint32_t index, Step step);
  void cast(std::size_t tile);
  /// How many rays a surface of so many samples has had once `step` is done.
  int raysAfter(Step step, int samples, bool fills) const;

  const Seen disc_;
  const LightTable& table_;
  const Surfaces& surfaces_;
  std::vector<std::vector<Tally>> tallies_;
  std::vector<std::vector<float>> shares_;
  std::atomic<std::size_t> rays_cast_{0};
  PixelMap met_;    ///< by the probes: kLit, kDark or both
  PixelMap mixed_;  ///< 1 where rays of one surface disagree
  PixelMap lit_;    ///< of four rays, for ShareWindows, where one surface fills a pixel and faces the disc
  PixelMap gaps_;   ///< 1 where probes of such surfaces met light, in blocks of 4 × 4 pixels
};

}  // namespace sunlit::light
