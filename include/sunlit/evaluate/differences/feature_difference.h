/// The difference made of matched features: equations (7) and (8) of the paper.
#pragma once

#include <cstddef>
#include <memory>

#include "sunlit/evaluate/differences/difference.h"

namespace sunlit::evaluate {

/// D = (F_total − F_matched) / F_total with F_total = F_a + F_b − F_matched, (7) and (8). NaN where F_total
/// is 0. With fewer than two descriptors in b no query can be told from its second best, so nothing matches
/// and D is 1.
///
/// The ratio test lets several features of a have one feature of b for their best. So F_matched can exceed
/// F_b, D can be below 0 (never above 1), and D(a, b) is not D(b, a). Beside it stand, of the same
/// neighbours: `symmetric`, the mean of D(a, b) and D(b, a); and `one_to_one`, D with only those matches that
/// are accepted from a to b and from b to a, as COLMAP's cross-check counts them: in [0, 1] and the same both
/// ways. `norm` is a cv::NormTypes.
DifferenceValue featureDifference(const Features& a, const Features& b, int norm, const RatioTest& test);

/// Numbers of descriptors.
struct FeatureCounts {
  std::size_t a = 0;
  std::size_t b = 0;
};

/// The same, of neighbours that are known already.
DifferenceValue featureDifference(const BothWays& nearest, const FeatureCounts& counts,
                                  const RatioTest& test);

/// That of a detector's features; its options are the detector's.
std::unique_ptr<Difference> makeFeatureDifference(std::unique_ptr<Detector> detector);

}  // namespace sunlit::evaluate
