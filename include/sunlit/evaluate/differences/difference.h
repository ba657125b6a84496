/// The differences between two images that can be asked for, by name.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sunlit/quantity/field.h"

namespace sunlit::evaluate {

/// In the order of the paper's tables.
enum class Difference {
  kBooleanRgb,
  kBooleanGrey,
  kEuclideanRgb,
  kEuclideanGrey,
  kSift,
  kSurf,
  kOrb,
  kBrisk
};

/// `boolean_rgb boolean_grey euclidean_rgb euclidean_grey sift surf orb brisk`; surf only where it was built
/// in.
const std::vector<Difference>& allDifferences();
/// As in parameters and result files.
const std::string& nameOf(Difference difference);
/// Some of them by their names.
Choices someOf(std::vector<Difference>* differences);
/// True for those that match features, equations (7) and (8); false for those that compare pixels, (3) to
/// (6).
bool usesFeatures(Difference difference);

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
