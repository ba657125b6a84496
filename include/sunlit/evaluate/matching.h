/// Brute-force matching with Lowe's ratio test, and the difference made of it: equations (7) and (8) of the
/// paper.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "sunlit/evaluate/difference.h"
#include "sunlit/evaluate/features.h"

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

/// The two nearest rows of `train` for each row of `query` by `norm` (a cv::NormTypes). Empty where `train`
/// has fewer than two rows: there is no second best then. Distances are those of cv::BFMatcher::knnMatch to
/// the bit.
std::vector<Neighbours> twoNearest(const cv::Mat& query, const cv::Mat& train, int norm);

/// True where the best match passes.
bool passes(const Neighbours& neighbours, const RatioTest& test);

/// D = (F_total − F_matched) / F_total with F_total = F_a + F_b − F_matched, (7) and (8). NaN where F_total
/// is 0. With fewer than two descriptors in b no query can be told from its second best, so nothing matches
/// and D is 1.
DifferenceValue featureDifference(const Features& a, const Features& b, int norm, const RatioTest& test);

}  // namespace sunlit::evaluate
