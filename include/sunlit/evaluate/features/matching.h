/// Brute-force matching with Lowe's ratio test, and the difference made of it: equations (7) and (8) of the
/// paper.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "sunlit/evaluate/differences/difference.h"
#include "sunlit/evaluate/features/features.h"

namespace sunlit::evaluate {

/// A query's best match is accepted where best < ratio · second best.
struct RatioTest {
  double ratio = 0.5;  ///< (0, 1]
  bool inclusive =
      false;  ///< accept best = ratio · second too, so that a twin of equal descriptor (0 = 0.5 · 0) passes
};

/// The two nearest descriptors of one query.
struct Neighbours {
  int best = -1;               ///< row of the nearest; the lowest one where several are equally near
  float best_distance = 0.0F;  ///< as cv::BFMatcher gives it
  float second_distance = 0.0F;
};

/// The two nearest of each descriptor of a among those of b, and the other way round.
struct BothWays {
  std::vector<Neighbours> from_a;  ///< by row of a; empty where b has fewer than two: there is no second best
  std::vector<Neighbours> from_b;  ///< by row of b; empty where a has fewer than two
};

/// By `norm` (a cv::NormTypes), in one pass over all distances. Neighbours and distances are those of
/// cv::BFMatcher::knnMatch, either way, to the bit.
BothWays twoNearestBothWays(const cv::Mat& a, const cv::Mat& b, int norm);

/// True where the best match passes.
bool passes(const Neighbours& neighbours, const RatioTest& test);

/// D = (F_total − F_matched) / F_total with F_total = F_a + F_b − F_matched, (7) and (8). NaN where F_total
/// is 0. With fewer than two descriptors in b no query can be told from its second best, so nothing matches
/// and D is 1.
///
/// The ratio test lets several features of a have one feature of b for their best. So F_matched can exceed
/// F_b, D can be below 0 (never above 1), and D(a, b) is not D(b, a). Beside it stand, of the same
/// neighbours: `symmetric`, the mean of D(a, b) and D(b, a); and `one_to_one`, D with only those matches that
/// are accepted from a to b and from b to a, as COLMAP's cross-check counts them: in [0, 1] and the same both
/// ways.
DifferenceValue featureDifference(const Features& a, const Features& b, int norm, const RatioTest& test);

}  // namespace sunlit::evaluate
