/// What is compared at one stamp, and what comes of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "evaluate/run/ground_truth.h"
#include "sunlit/evaluate/differences/comparer.h"
#include "sunlit/evaluate/verify/lost_features.h"
#include "sunlit/evaluate/verify/verify.h"

namespace sunlit::evaluate {

/// Images of one set that go to the comparer.
struct PoseWork {
  std::int64_t pose = 0;
  std::int64_t stamp_ns = 0;
  bool is_by_order = false;     // its pose, which a capture may still correct
  std::vector<cv::Mat> images;  // by stream
  std::vector<std::size_t> pairs;
  std::vector<std::size_t> pictures;  // streams whose image is kept
  bool is_drawn = false;              // which matches are right
  GroundTruth::View truth;
  std::vector<char> observed;  // by stream: its features are kept to localise by
  std::size_t bytes = 0;
};

/// What comes of a PoseWork, by pair and then by difference, or by detector that is verified.
struct PoseValues {
  std::vector<std::vector<DifferenceValue>> differences;
  std::vector<std::vector<Verified>> verified;
  std::vector<std::vector<LostFeatures>> lost;
  std::vector<std::vector<cv::Mat>> drawn;         // empty where nothing is drawn
  std::vector<std::optional<std::string>> faults;  // of pairs that could not be compared
  std::map<std::size_t, std::string> unobserved;   // by stream: which of its detectors have nothing, and why
  std::vector<std::vector<char>> is_featureless;   // [stream][difference]
};

}  // namespace sunlit::evaluate
