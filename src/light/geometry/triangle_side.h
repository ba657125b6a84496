/// Triangles have two sides, which are lit and look apart.
#pragma once

#include <cstdint>

namespace sunlit::light {

/// One side of a triangle of the scene.
struct TriangleSide {
  std::uint32_t triangle;
  bool front;
};

}  // namespace sunlit::light
