#include "sunlit/evaluate/features/detector.h"

#include <utility>

#include "evaluate/features/detectors.h"
#include "sunlit/quantity/range.h"

namespace sunlit::evaluate {
namespace {

struct DetectorType {
  std::string name;
  std::unique_ptr<Detector> (*make)();
};

/// In the order of the paper's tables.
const std::vector<DetectorType>& table() {
  static const std::vector<DetectorType> rows = {{"sift", makeSift},
#ifdef SUNLIT_SURF
                                                 {"surf", makeSurf},
#endif
                                                 {"orb", makeOrb},
                                                 {"brisk", makeBrisk}};
  return rows;
}

}  // namespace

const std::vector<std::string>& detectorTypes() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const DetectorType& type : table()) all.push_back(type.name);
    return all;
  }();
  return names;
}

std::unique_ptr<Detector> makeDetector(const std::string& type) {
  for (const DetectorType& row : table()) {
    if (row.name == type) return row.make();
  }
  refuse("detector", '"' + type + '"', "one of " + textOf(detectorTypes()));
}

Features detectFeatures(const Detector& detector, const cv::Mat& grey) {
  Features features;
  detector.make()->detectAndCompute(grey, cv::noArray(), features.key_points, features.descriptors);
  return features;
}

}  // namespace sunlit::evaluate
