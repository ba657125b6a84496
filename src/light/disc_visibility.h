/// How much of a distant disc, the sun or the moon, each surface of a picture sees.
#pragma once

#include <Eigen/Core>
#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "light/light_table.h"
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
  /// away.
  const std::vector<float>& visibleShares(std::size_t tile) const { return shares_[tile]; }
  /// How many rays that took, without those that surfaces hide themselves.
  std::size_t raysCast() const { return rays_cast_; }

 private:
  /// What the rays of one surface met, and what the later steps need to know of it: surfaces are large, and
  /// going through all of them again takes as long as their rays.
  struct Tally {
    std::uint32_t pixel = 0;
    std::uint8_t cast = 0, lit = 0;
    bool leaves = false;  ///< it has holes, as foliage
    bool waits = false;   ///< had no probe: first its neighbours are asked
    bool mixed() const { return lit > 0 && lit < cast; }
  };
  /// Each step casts more rays, where those of the step before found an edge.
  enum class Step {
    kProbe,   ///< one ray a surface, or in every second pixel where one solid surface fills pixels
    kSample,  ///< as many as it has samples, where probes within two pixels met both light and dark
    kRefine,  ///< many over the disc, in penumbrae
  };
  struct RayList;
  /// One byte a pixel, with a margin, so that each has neighbours all around.
  class PixelMap {
   public:
    PixelMap(int width, int height)
        : stride_(static_cast<std::size_t>(width) + 2 * kMargin),
          width_(static_cast<std::uint32_t>(width)),
          values_(stride_ * (static_cast<std::size_t>(height) + 2 * kMargin) + sizeof(std::uint64_t), 0) {}
    std::uint8_t& at(std::uint32_t pixel) { return values_[place(pixel)]; }
    /// All bits of the 5 × 5 pixels about this one.
    std::uint8_t anyAround(std::uint32_t pixel) const;
    /// How many of the pixel and its eight neighbours are not 0.
    int countAround(std::uint32_t pixel) const;

   private:
    static constexpr std::size_t kMargin = 2;
    std::size_t place(std::uint32_t pixel) const {
      return (pixel / width_ + kMargin) * stride_ + pixel % width_ + kMargin;
    }
    std::size_t stride_;
    std::uint32_t width_;
    std::vector<std::uint8_t> values_;
  };

  void castAll();
  void castTile(std::size_t tile, Step step);
  bool facesDisc(const LightTable::Site& site) const;
  bool mayWait(const LightTable::Site& site) const;
  bool wantsMore(const Tally& tally, Step step) const;
  /// Rays of surface `index` of a tile that it has not had yet.
  void appendRays(const Tile& tile, const LightTable::Site& site, std::uint32_t index, Step step,
                  Tally* tally, RayList* rays) const;
  void cast(const RayList& rays, std::vector<Tally>* tallies);
  void note(std::size_t tile, Step step);
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
  std::array<Eigen::Vector3f, kPoints>
      directions_;  ///< to points all over the disc, in the order of their use
  std::vector<std::vector<Tally>> tallies_;
  std::vector<std::vector<float>> shares_;
  std::atomic<std::size_t> rays_cast_{0};
  PixelMap met_;    ///< by the probes: kLit, kDark or both
  PixelMap mixed_;  ///< 1 where rays of one surface disagree
};

}  // namespace sunlit::light
