/// Which poses of a path are expected.
#pragma once

#include <cstddef>
#include <cstdint>

namespace sunlit::evaluate {

/// As the renderer's path/first, path/count and path/stride: every stride-th of `count` indices from `first`
/// on.
struct PoseRange {
  std::size_t count = 0;    ///< indices from the first on; 0: unknown, it has no end
  std::int64_t first = 0;   ///< ≥ 0
  std::int64_t stride = 1;  ///< ≥ 1

  /// How many poses are expected; 0 where that is unknown.
  std::size_t size() const;
  bool holds(std::int64_t pose) const;
  /// The k-th of them.
  std::int64_t at(std::size_t k) const { return first + stride * static_cast<std::int64_t>(k); }
};

}  // namespace sunlit::evaluate
