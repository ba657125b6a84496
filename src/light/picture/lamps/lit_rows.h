/// What a tile's surfaces show to lamps, each value of all surfaces side by side: lamps by the hundred meet
/// the same ones.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "light/lamps/lamp_beam.h"
#include "light/shading/mirrored_by_rays.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/scene/scene.h"

namespace sunlit::light {

class LitRows {
 public:
  /// Rows are that much longer than there are surfaces, up to a multiple of it; what stands there is not
  /// used.
  static constexpr std::size_t kBlock = 16;

  /// Takes what it needs of all surfaces of `tile`.
  void set(const Tile& tile, const scene::Scene& scene, MirrorsByRays by_rays = kSmoothOnes);

  std::size_t count() const { return count_; }
  /// count() rounded up to kBlock.
  std::size_t stride() const { return stride_; }
  /// All stride() of them.
  LampBeam::Points positions() const;

  /// How much of a lamp's light arrives at each surface.
  struct Arriving {
    const float* shares;    ///< LampBeam::share(), stride() of them
    const float* least_lx;  ///< a surface that gets no more than that, facing the lamp, is left out
  };
  /// Luminances by a lamp where nothing is in the way, cd/m².
  struct Reflected {
    std::vector<float> values;          ///< red, green, blue and the largest of them, stride() each
    std::vector<std::uint32_t> blocks;  ///< where they begin; elsewhere nothing arrives, and no value is set
  };
  /// directReflectance() times what arrives, within 0.1 % for roughness from 0.2 (3 % near a ball as wide as
  /// it is far); 0 of a surface left out or turned away. Of light that a surface passes on without what is
  /// mirrored by rays.
  void reflect(const LampBeam& beam, const Arriving& arriving, Reflected* reflected) const;

 private:
  std::size_t count_ = 0, stride_ = 0;
  std::vector<float> rows_;
  Eigen::AlignedBox3f box_;  ///< of their positions
};

}  // namespace sunlit::light
