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

/// Those of the paper in the order of its tables, then others.
const std::vector<DetectorType>& table() {
  static const std::vector<DetectorType> rows = {{"sift", makeSift},
#ifdef SUNLIT_SURF
                                                 {"surf", makeSurf},
#endif
                                                 {"orb", makeOrb},          {"brisk", makeBrisk},
                                                 {"akaze", makeAkaze},      {"kaze", makeKaze},
                                                 {"rootsift", makeRootSift}};
  return rows;
}

/// A detector that says its type.
class Typed : public Detector {
 public:
  Typed(std::string type, std::unique_ptr<Detector> detector)
      : type_(std::move(type)), detector_(std::move(detector)) {}
  std::unique_ptr<Detector> clone() const override {
    return std::make_unique<Typed>(type_, detector_->clone());
  }
  std::vector<Field> fields() override {
    return joined({{{"type", OwnForm{type_}, "", {}, "of the detector"}}, detector_->fields()});
  }
  int norm() const override { return detector_->norm(); }
  cv::Ptr<cv::Feature2D> make() const override { return detector_->make(); }

 private:
  std::string type_;
  std::unique_ptr<Detector> detector_;
};

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

std::unique_ptr<Detector> makeTypedDetector(const std::string& type) {
  return std::make_unique<Typed>(type, makeDetector(type));
}

Features detectFeatures(const Detector& detector, const cv::Mat& grey) {
  Features features;
  detector.make()->detectAndCompute(grey, cv::noArray(), features.key_points, features.descriptors);
  return features;
}

}  // namespace sunlit::evaluate
