/// The differences between two images that can be asked for, by name.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

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
/// Throws std::invalid_argument, naming what is allowed, for an unknown name and for a surf that was not
/// built in.
Difference differenceNamed(const std::string& name);
/// True for those that match features, equations (7) and (8); false for those that compare pixels, (3) to
/// (6).
bool usesFeatures(Difference difference);

/// One difference of one pair of images.
struct DifferenceValue {
  double value = 0.0;            ///< D; NaN where it is undefined: no features in either image
  std::uint32_t features_a = 0;  ///< key points; 0 for differences of pixels
  std::uint32_t features_b = 0;
  std::uint32_t matches = 0;      ///< F_matched, from a to b
  std::uint32_t zero_second = 0;  ///< queries whose second neighbour is at distance 0 (twins in b)
};

}  // namespace sunlit::evaluate
