/// One sample of the geometry buffer.
#pragma once

#include <cstdint>

namespace sunlit::render {

struct Sample {
  std::uint32_t triangle =
      0;               ///< number of the triangle seen plus 1, those of bodies after the fixed; 0 for sky
  float depth = 0.0f;  ///< m along the optical axis

  bool sky() const { return triangle == 0; }
};

}  // namespace sunlit::render
