/// All wanted differences of all wanted pairs among the images of one pose.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>
#include <vector>

#include "sunlit/evaluate/differences/differences.h"
#include "sunlit/evaluate/features/feature_cache.h"

namespace sunlit::evaluate {

class DetectorPool;

struct ComparerOptions {
  Differences known;  ///< each with its options
  std::vector<std::string> differences = paperDifferences();
  RatioTest ratio_test;
  std::shared_ptr<FeatureCache> cache;  ///< of features; null: none are kept
};

/// Rows of what decides the values: options of those differences only that are asked for.
std::vector<Field> decidingFieldsOf(ComparerOptions& options);
/// Of all of them.
std::vector<Field> fieldsOf(ComparerOptions& options);

/// SIFT and ORB, where they are among the differences: what is verified and localised by unless told
/// otherwise.
std::vector<std::string> usualDetectors(const ComparerOptions& options);

/// The detector of the first of the differences that has one; null where none has.
const Detector* firstDetectorOf(const ComparerOptions& options);

/// Indices of two images; the first gives the queries.
using ImagePair = std::pair<std::size_t, std::size_t>;

/// What one difference that has a detector found in one pair of images, for whoever asks more of it.
struct Matched {
  std::size_t pair;        ///< index of the pair
  std::size_t difference;  ///< index into ComparerOptions::differences
  const Features& a;
  const Features& b;
  const BothWays& nearest;  ///< of their descriptors
};
using MatchedVisit = std::function<void(const Matched&)>;

class Comparer {
 public:
  /// Throws std::invalid_argument for an option out of range, naming it as in the parameters of the
  /// evaluator.
  explicit Comparer(const ComparerOptions& options);
  ~Comparer();

  const ComparerOptions& options() const { return options_; }
  /// For each pair its values in the order of options().differences. Features of each image that a pair uses
  /// are found once. Images are CV_8UC3, red first; both of a pair of equal size. Runs in parallel; may be
  /// called from several threads at once. The result does not depend on the number of threads. `visit` is
  /// called once for each pair and difference that has a detector, from several threads at once, and may
  /// throw. Throws Stopped once `stop` says so and the detectors at work, which cannot be stopped, are done.
  std::vector<std::vector<DifferenceValue>> compare(const std::vector<cv::Mat>& rgb_images,
                                                    const std::vector<ImagePair>& pairs,
                                                    const StopToken& stop = {},
                                                    const MatchedVisit& visit = {}) const;

 private:
  struct Asked {
    const Difference* difference;
    std::unique_ptr<DetectorPool> detectors;  // null where it has none
  };
  ComparerOptions options_;
  std::vector<Asked> asked_;
};

}  // namespace sunlit::evaluate
