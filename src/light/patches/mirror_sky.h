/// The sky as mirrors see it: by patches for rough ones, and for smooth ones as tables by direction, each
/// blurred over a cap of another size.
#pragma once

#include <Eigen/Core>
#include <Eigen/StdVector>
#include <array>
#include <cstdint>
#include <vector>

#include "light/patches/patch_sky.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

class MirrorSky {
 public:
  explicit MirrorSky(const sky::Daylight& day);

  const PatchSky& patches() const { return patches_; }
  /// Mean over the part of a cap that is above the horizon, cd/m², the fourth is padding; zero where the
  /// cap's middle is below. `place`, of SmoothMirror, is one in the tables, octahedral maps of the sphere,
  /// and stands for what MirrorLobe::towards says: a direction, and by its length the size of the cap.
  const Eigen::Array4f& luminance(std::uint16_t place) const { return table_[place]; }

 private:
  PatchSky patches_;
  std::vector<Eigen::Array4f, Eigen::aligned_allocator<Eigen::Array4f>> table_;
};

}  // namespace sunlit::light
