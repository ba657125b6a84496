/// What a difference of two images is told by.
#pragma once

#include <cstdint>

namespace sunlit::evaluate {

/// One difference of one pair of images. Differences of pixels are the same both ways: their three values are
/// one.
struct DifferenceValue {
  double value = 0.0;       ///< D of the paper, ≤ 1; NaN where it is undefined: no features in either image
  double symmetric = 0.0;   ///< mean of D(a, b) and D(b, a)
  double one_to_one = 0.0;  ///< D of matches that are each other's, 0 … 1
  std::uint32_t features_a = 0;  ///< key points; 0 for differences of pixels, as all below
  std::uint32_t features_b = 0;
  std::uint32_t matches = 0;             ///< F_matched, from a to b
  std::uint32_t matches_back = 0;        ///< from b to a
  std::uint32_t matches_one_to_one = 0;  ///< of both kinds at once, between the same two features
  std::uint32_t zero_second = 0;         ///< queries whose second neighbour is at distance 0 (twins in b)
  /// More features of a have their match in b than b has features: several share one, and D may be below 0.
  bool isOvermatched() const { return matches > features_b; }
};

}  // namespace sunlit::evaluate
