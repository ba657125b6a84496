/// All wanted differences of all wanted pairs among the images of one pose.
#pragma once

#include <cstddef>
#include <exception>
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

/// What the detector of one difference found in one image, for whoever asks more of it.
struct Found {
  std::size_t image;       ///< its index
  std::size_t difference;  ///< index into ComparerOptions::differences
  const Features& features;
};

/// Likewise in one pair of images.
struct Matched {
  std::size_t pair;  ///< index of the pair
  std::size_t difference;
  const Features& a;
  const Features& b;
  const BothWays& nearest;  ///< of their descriptors
};

/// Both are called from several threads at once, and may throw.
struct CompareVisits {
  std::function<void(const Found&)> found;      ///< once for each image and difference that has a detector
  std::function<void(const Matched&)> matched;  ///< likewise for each pair that is matched
};

/// What came of each pair, and what was thrown instead, null where nothing was.
struct Compared {
  std::vector<std::vector<DifferenceValue>>
      values;  ///< [pair][difference]; of a pair with a fault, of no use
  /// By pair: what was thrown of its images, of the first difference and there of the first image; else of
  /// itself, of the first difference. A pair whose images have a fault is not matched.
  std::vector<std::exception_ptr> faults;
  std::vector<std::vector<std::exception_ptr>> image_faults;  ///< [difference][image]
};

class Comparer {
 public:
  /// Throws std::invalid_argument for an option out of range, naming it as in the parameters of the
  /// evaluator.
  explicit Comparer(const ComparerOptions& options);
  ~Comparer();

  const ComparerOptions& options() const { return options_; }
  /// For each pair its values in the order of options().differences. Features of each image that a pair uses
  /// are found once. Images are CV_8UC3, red first; both of a pair of equal size. Runs in parallel; may be
  /// called from several threads at once. The result does not depend on the number of threads. Throws what is
  /// thrown of the first pair that has a fault, and Stopped once `stop` says so, when the detectors at work,
  /// which cannot be stopped, are done.
  std::vector<std::vector<DifferenceValue>> compare(const std::vector<cv::Mat>& rgb_images,
                                                    const std::vector<ImagePair>& pairs,
                                                    const StopToken& stop = {}) const;
  /// The same, but an image of which something is thrown costs its own pairs alone, and a pair itself. Throws
  /// Stopped.
  Compared compareEach(const std::vector<cv::Mat>& rgb_images, const std::vector<ImagePair>& pairs,
                       const StopToken& stop, const CompareVisits& visits) const;

 private:
  struct Asked {
    const Difference* difference;
    std::unique_ptr<DetectorPool> detectors;  // null where it has none
  };
  /// What there is to match: [difference][image].
  struct Seen {
    std::vector<Picture> pictures;  // by image
    std::vector<std::vector<Features>> features;
    std::vector<std::vector<std::exception_ptr>> faults;
    std::exception_ptr faultOf(const ImagePair& pair) const;
  };
  Seen look(const std::vector<cv::Mat>& rgb_images, const std::vector<ImagePair>& pairs,
            const StopToken& stop, const CompareVisits& visits) const;
  ComparerOptions options_;
  std::vector<Asked> asked_;
};

}  // namespace sunlit::evaluate
