/// How much of a distant disc, the sun or the moon, each surface of a picture sees.
#pragma once

#include <Eigen/Core>
#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "light/light_table.h"
#include "light/pixel_map.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

class DiscVisibility {
 public:
  /// Casts all rays, in parallel, unless the disc gives less than `least_lx` on a plane facing it. Keeps
  /// references; `table` is of `surfaces`.
  DiscVisibility(const sky::DiscLight& disc, float least_lx, const Visibility& visibility,
                 const LightTable& table, const Surfaces& surfaces);

  const Eigen::Vector3f& towards() const { return towards_; }
  float radius_rad() const { return radius_rad_; }

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
    bool leaves;           ///< it has holes, as foliage
    bool fills;            ///< alone in its pixel, and not foliage
    bool waits = false;    ///< had no probe: first its neighbours are asked
    bool settled = false;  ///< they knew
    bool mixed() const { return lit > 0 && lit < cast; }
  };
  /// Each step casts more rays, where those of the step before found an edge.
  enum class Step {
    kProbe,     ///< one ray a surface, or in every second pixel where one solid surface fills pixels
    kSample,    ///< as many as it has samples, where probes within two pixels met both light and dark
    kRefine,    ///< half of the points on the disc, in penumbrae
    kComplete,  ///< all of them, where the neighbours' other half does not do
  };

  void castAll();
  void probe(std::size_t tile);
  void sample(std::size_t tile);
  void refine(std::size_t tile);
  void complete(std::size_t tile);
  bool facesDisc(const LightTable::Site& site) const;
  bool fillsPixel(const LightTable::Site& site) const;
  /// The share of a surface that has had half of the points; negative if its neighbours differ too much from
  /// it for their half to stand for the rest.
  float shareAmongNeighbours(const Tile& tile, const Tally& tally) const;
  /// Rays of surface `index` of a tile that it has not had yet.
  void appendRays(std::size_t tile, std::uint32_t index, Step step);
  void cast(std::size_t tile);
  /// How many rays a surface of so many samples has had once `step` is done.
  int raysAfter(Step step, int samples) const;

  const Visibility& visibility_;
  const LightTable& table_;
  const Surfaces& surfaces_;
  bool shines_;  ///< false when it gives no light worth casting rays for
  Eigen::Vector3f towards_;
  float radius_rad_;
  Eigen::Vector3f across_, up_;  ///< unit, at right angles to `towards_`
  static constexpr int kPoints = 16;
  /// To points all over the disc, in the order of their use: in even pixels, and in odd ones.
  std::array<std::array<Eigen::Vector3f, kPoints>, 2> directions_;
  std::vector<std::vector<Tally>> tallies_;
  std::vector<std::vector<float>> shares_;
  std::atomic<std::size_t> rays_cast_{0};
  PixelMap met_;    ///< by the probes: kLit, kDark or both
  PixelMap mixed_;  ///< 1 where rays of one surface disagree
  PixelMap share_;  ///< 1 + the visible share in eighths, where one surface fills a pixel and faces the disc
};

}  // namespace sunlit::light
