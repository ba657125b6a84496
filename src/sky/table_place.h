/// Where a coordinate lies between the nodes of a table.
#pragma once

#include <algorithm>

namespace sunlit::sky {

/// A cell of one axis of a table, and the place within it.
struct TablePlace {
  int index;       ///< of the node at or before it, 0 … count − 2
  float fraction;  ///< of the way to the next node, 0 … 1
};

/// `coordinate` counts nodes from 0 and is clamped to 0 … count − 1; count ≥ 2.
inline TablePlace placeAt(float coordinate, int count) {
  const float x = std::clamp(coordinate, 0.0F, static_cast<float>(count - 1));
  const int index = std::min(static_cast<int>(x), count - 2);
  return {index, x - static_cast<float>(index)};
}

}  // namespace sunlit::sky
