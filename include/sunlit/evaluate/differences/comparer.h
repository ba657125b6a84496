/// All wanted differences of all wanted pairs among the images of one pose.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>
#include <vector>

#include "sunlit/evaluate/differences/difference.h"
#include "sunlit/evaluate/features/features.h"
#include "sunlit/evaluate/features/matching.h"

namespace sunlit::evaluate {

class DetectorPool;

struct ComparerOptions {
  std::vector<Difference> differences = allDifferences();
  FeatureOptions features;
  RatioTest ratio_test;
};

inline std::vector<Field> fieldsOf(ComparerOptions& options) {
  RatioTest& test = options.ratio_test;
  return joined(
      {{{"differences", someOf(&options.differences), "", {}, "by name; surf only where it was built in"},
        {"ratio", &test.ratio, "", Range::above(0, 1), "a match counts where best < ratio * second best"},
        {"inclusive", &test.inclusive, "", {}, "<= instead of <: a query with a twin then passes"}},
       under("features", fieldsOf(options.features))});
}

/// Indices of two images; the first gives the queries.
using ImagePair = std::pair<std::size_t, std::size_t>;

class Comparer {
 public:
  /// Throws std::invalid_argument for an option out of range, naming it as in the parameters of the
  /// evaluator.
  explicit Comparer(const ComparerOptions& options);
  ~Comparer();

  const ComparerOptions& options() const { return options_; }
  /// For each pair its values in the order of options().differences. Features of each image that a pair uses
  /// are found once. Images are CV_8UC3, red first; both of a pair of equal size. Runs in parallel; may be
  /// called from several threads at once. The result does not depend on the number of threads. It means
  /// nothing once `is_broken_off` turns true, which ends the work within one detector's.
  std::vector<std::vector<DifferenceValue>> compare(const std::vector<cv::Mat>& rgb_images,
                                                    const std::vector<ImagePair>& pairs,
                                                    const std::atomic<bool>* is_broken_off = nullptr) const;

 private:
  ComparerOptions options_;
  std::unique_ptr<DetectorPool> detectors_;
};

}  // namespace sunlit::evaluate
