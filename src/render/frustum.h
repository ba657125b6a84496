/// Which boxes a view may see.
#pragma once

#include <array>

#include "render/view.h"

namespace sunlit::render {

class Frustum {
 public:
  explicit Frustum(const View& view);
  /// False only if no point of the box is in view.
  bool touches(const Eigen::AlignedBox3f& box) const;

 private:
  struct HalfSpace {
    Eigen::Vector3d inwards;
    double offset;  ///< inside is inwards · p ≥ offset
  };
  std::array<HalfSpace, 6> sides_;
};

}  // namespace sunlit::render
