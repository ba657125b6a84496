/// The sky as level ground mirrors it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "light/patches/sky_patches.h"

namespace sunlit::light {

/// At a glancing angle even rough ground mirrors a low sky and sun: walls get a twentieth more light by it
/// than from ground that reflects evenly.
class GroundMirror {
 public:
  /// Luminance × π, mirrored towards one direction, for 1 lx from each patch; a dielectric's.
  using Row = std::array<float, SkyPatches::kCount>;

  /// The one that there is: made when first asked for, in 0.4 s of processor time.
  static const GroundMirror& get();

  /// Towards where ray `down` of the patches' coarse rays below the horizon, 0 … SkyPatches::kDown − 1, comes
  /// from.
  const Row& towards(std::size_t down, float roughness) const;

 private:
  GroundMirror();

  static constexpr std::size_t kRoughnesses = 16;
  std::vector<Row> rows_;  ///< by roughness, then ray
};

}  // namespace sunlit::light
