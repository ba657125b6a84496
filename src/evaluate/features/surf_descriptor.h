// The descriptor of a patch: sums of gradients over 4 x 4 cells (Bay et al. 2008, 4.2).
#pragma once

#include <array>

#include "evaluate/features/surf_patch.h"

namespace sunlit::evaluate::surf {

class Descriptor {
 public:
  explicit Descriptor(bool extended);
  int size() const { return extended_ ? 128 : 64; }

  // Writes size() numbers of length 1 (all 0 for a flat patch): per cell, row by row, the sums of dx, dy,
  // |dx|, |dy|; extended, of dx and |dx| where dy >= 0, then where dy < 0, and of dy and |dy| where dx >= 0,
  // then where dx < 0.
  void of(const Patch& patch, float* out) const;

 private:
  static constexpr int kSide = kPatchSide - 1;
  using Row = std::array<float, kSide>;
  bool extended_;
  std::array<Row, kSide> weights_;
};

}  // namespace sunlit::evaluate::surf
