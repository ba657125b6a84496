/// All wanted differences of all wanted pairs among the images of one pose.
#pragma once

#include <cstddef>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>
#include <vector>

#include "sunlit/evaluate/difference.h"
#include "sunlit/evaluate/features.h"
#include "sunlit/evaluate/matching.h"

namespace sunlit::evaluate {

class DetectorPool;

struct ComparerOptions {
  std::vector<Difference> differences = allDifferences();
  FeatureOptions features;
  RatioTest ratio_test;
};

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
  /// called from several threads at once. The result does not depend on the number of threads.
  std::vector<std::vector<DifferenceValue>> compare(const std::vector<cv::Mat>& rgb_images,
                                                    const std::vector<ImagePair>& pairs) const;

 private:
  ComparerOptions options_;
  std::unique_ptr<DetectorPool> detectors_;
};

}  // namespace sunlit::evaluate
