/// The sphere in patches, each taken as of one luminance.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sunlit/quantity/direction.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

/// Share of a patch.
struct PatchShare {
  int patch;
  float share;
};

/// The division of Tregenza (1987) with its lowest ring cut at 4°, where a low sun's height over the ground
/// matters most: 175 patches above the horizon, and one below it.
class SkyPatches {
 public:
  static constexpr int kAbove = 175;
  static constexpr int kBelow = kAbove;  ///< index of the patch below the horizon
  static constexpr int kCount = 176;
  /// Patches above the horizon between two elevations.
  struct Ring {
    double low_deg, high_deg;
    int patches;
    int first;  ///< index of its first patch
  };
  static constexpr std::array<Ring, 9> kRings = {{{0, 4, 30, 0},
                                                  {4, 12, 30, 30},
                                                  {12, 24, 30, 60},
                                                  {24, 36, 24, 90},
                                                  {36, 48, 24, 114},
                                                  {48, 60, 18, 138},
                                                  {60, 72, 12, 156},
                                                  {72, 84, 6, 168},
                                                  {84, 90, 1, 174}}};
  static constexpr int kDown = 160;               ///< directions below the horizon
  static constexpr int kCoarse = kAbove + kDown;  ///< one a patch above the horizon, and those below it

  /// One direction that stands for a part of the sphere.
  struct Ray {
    Eigen::Vector3f towards;  ///< unit
    float solid_angle;        ///< sr
    int patch;
    int coarse;  ///< its index among the coarse rays, or kFineOnly
    static constexpr int kFineOnly = -1;
  };

  /// `rays_per_patch` > 0.
  explicit SkyPatches(int rays_per_patch);

  /// Sample the sphere finely above the horizon, and at the coarse directions below it.
  const std::vector<Ray>& rays() const { return rays_; }
  /// Those of them that sample the whole sphere coarsely; index k < kAbove stands for patch k.
  const std::vector<Ray>& coarseRays() const { return coarse_; }

  /// What directions within a patch count by: the cosine to the zenith, so that level ground gets exactly its
  /// light from a sky that changes within a patch, or all alike.
  enum class Weight { kCosine, kEven };
  /// Mean luminance of each patch, cd/m², without the discs; below the horizon by kEven.
  static std::array<Eigen::Array3f, kCount> luminances(const sky::Daylight& day, Weight weight);
  /// Between which patches a small light is divided; shares sum to 1 and change continuously with direction.
  static std::array<PatchShare, 4> around(const Eigen::Vector3f& towards);
  /// The point of a patch above the horizon at shares (u, v) of its azimuth and of the sine of its elevation.
  static Eigen::Vector3f pointIn(int patch, double u, double v);
  /// The patch that a direction, unit, lies in.
  static int patchAt(const Eigen::Vector3f& towards);
  /// Index into kRings of the ring that a patch above the horizon is in.
  static std::size_t ringOf(int patch);
  /// Patches above the horizon that share a border with one.
  static std::vector<int> neighbours(int patch);
  /// Whether a coarse ray belongs to one half of them, which has some of every ring.
  static bool inHalf(int coarse) { return (coarse + coarse / kRings[0].patches) % 2 == 0; }
  /// Solid angle of a patch above the horizon, sr.
  static float solidAngle(int patch);

 private:
  std::vector<Ray> rays_, coarse_;
};

/// How much of each patch is open, 255 for all; below the horizon nothing.
using PatchBytes = std::array<std::uint8_t, SkyPatches::kCount>;

}  // namespace sunlit::light
