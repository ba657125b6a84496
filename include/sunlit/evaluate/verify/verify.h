/// Features of two pictures, checked against where their points truly lie: not how many match, but how many
/// match rightly.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "sunlit/evaluate/differences/differences.h"
#include "sunlit/evaluate/features/feature_cache.h"
#include "sunlit/evaluate/features/features.h"
#include "sunlit/evaluate/features/matching.h"
#include "sunlit/evaluate/verify/point_maps.h"
#include "sunlit/quantity/field.h"

namespace sunlit::evaluate {

/// A match is correct where the point of a, mapped, is at most so far from the point of b, unless a measure
/// says otherwise. In px of b.
constexpr double kCorrectWithin_px = 3.0;
/// The matching accuracy is told at 1, 2, … px.
constexpr std::size_t kAccuracySteps = 10;

/// What one detector's features of a and b are worth. A point is common where the map gives its place in the
/// other picture. A match is a feature of a and the one of b with the nearest descriptor; it is mutual where
/// a is the nearest of b too (of several equally near the one found first). NaN: undefined.
struct Verified {
  std::size_t common_a = 0;  ///< features of a in the common part
  std::size_t common_b = 0;
  /// Features of a, in the common part, near whose place in b there is any feature of b.
  std::size_t correspondences = 0;
  std::size_t mutual_matches = 0;
  /// Mean of two shares, one of the common points of a and one of those of b: of those that have a partner
  /// among the common points of the other within 3 px of their place there, each partner being that of one.
  /// Partners are given to the nearest pair first; of equally near ones to that which begins with the feature
  /// found first, and then to that which ends with the one found first. [0, 1]; 0 where only one has common
  /// points, NaN where neither has.
  double repeatability = 0.0;
  /// Correct mutual matches / features of a or of b, whichever are fewer, common or not. [0, 1]; 0 where only
  /// one has features, NaN where neither has.
  double matching_score = 0.0;
  /// [t − 1]: correct mutual matches, within t px, / all mutual matches; a match of a point outside the
  /// common part is wrong. 0 where there are none.
  std::array<double, kAccuracySteps> matching_accuracy{};
  /// Correct accepted matches / accepted matches, those of a that pass the ratio test. NaN where none does.
  double precision = 0.0;
  /// Correct accepted matches / correspondences. [0, 1]; NaN without correspondences.
  double recall = 0.0;
  /// Area below precision over recall as the ratio goes through all values of best / second best that occur,
  /// matches of one value being accepted at once: Σ (R_k − R_k−1) P_k, without interpolation. A best and
  /// second best of 0 have the ratio 1, since they cannot be told apart. NaN without correspondences.
  double average_precision = 0.0;
  /// Accepted matches and the paper's D.
  DifferenceValue difference;
};

/// What one detector found in both pictures.
struct FeaturePair {
  const Features& a;
  const Features& b;
  const BothWays& nearest;  ///< of their descriptors
};

/// Deterministic to the bit, whatever the number of threads. One key point a descriptor
/// (std::invalid_argument otherwise).
Verified verify(const FeaturePair& features, const PointMaps& maps, const RatioTest& test);

/// A match of a that passes the ratio test.
struct AcceptedMatch {
  std::size_t a;  ///< indices of the features
  std::size_t b;
  float distance;  ///< of their descriptors
  bool is_right;   ///< as for Verified::precision
};
/// In the order of the features of a. Throws as verify().
std::vector<AcceptedMatch> acceptedMatches(const FeaturePair& features, const PointMaps& maps,
                                           const RatioTest& test);

/// Those of paperDifferences() that match features.
std::vector<std::string> paperDetectors();

struct VerifyOptions {
  Differences known;                                      ///< whose detectors are used, with their parameters
  Preprocessings preprocessings;                          ///< likewise
  std::vector<std::string> detectors = paperDetectors();  ///< some of detectorNames()
  RatioTest ratio_test;
  std::shared_ptr<FeatureCache> cache;  ///< of features; null: none are kept
};

std::vector<Field> fieldsOf(VerifyOptions& options);

/// One of options.detectors with its parameters. Throws std::invalid_argument for a name that there is not.
std::unique_ptr<Detector> detectorOf(const VerifyOptions& options, const std::string& name);

/// CV_8UC3, red first; of any sizes.
struct ImagesToVerify {
  cv::Mat rgb_a;
  cv::Mat rgb_b;
};

/// verify() of what each detector finds, in the order of options.detectors. In parallel; the result does not
/// depend on the number of threads. Throws std::invalid_argument for an option out of range.
std::vector<Verified> verifyImages(const ImagesToVerify& images, const PointMaps& maps,
                                   const VerifyOptions& options);

}  // namespace sunlit::evaluate
