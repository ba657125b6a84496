/// Brute-force matching with Lowe's ratio test.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "sunlit/evaluate/stop_token.h"
#include "sunlit/quantity/field.h"

namespace sunlit::evaluate {

/// A query's best match is accepted where best < ratio · second best.
struct RatioTest {
  double ratio = 0.5;  ///< (0, 1]
  bool inclusive =
      false;  ///< accept best = ratio · second too, so that a twin of equal descriptor (0 = 0.5 · 0) passes
};

inline std::vector<Field> fieldsOf(RatioTest& test) {
  return {{"ratio", &test.ratio, "", Range::above(0, 1), "a match counts where best < ratio * second best"},
          {"inclusive", &test.inclusive, "", {}, "<= instead of <: a query with a twin then passes"}};
}

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
/// cv::BFMatcher::knnMatch, either way, to the bit. Of n rows each this takes n² steps, many seconds for
/// 100,000: `stop` is checked every few rows.
BothWays twoNearestBothWays(const cv::Mat& a, const cv::Mat& b, int norm, const StopToken& stop = {});

/// True where the best match passes.
bool passes(const Neighbours& neighbours, const RatioTest& test);

}  // namespace sunlit::evaluate
