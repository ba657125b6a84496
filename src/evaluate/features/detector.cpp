#include "sunlit/evaluate/features/detector.h"

#include <cstdio>
#include <stdexcept>
#include <utility>
#include <variant>

#include "evaluate/features/detectors.h"
#include "sunlit/evaluate/features/detector_plugin.h"
#include "sunlit/quantity/range.h"

namespace sunlit::evaluate {
namespace {

struct DetectorType {
  std::string name;
  std::unique_ptr<Detector> (*make)();
  bool is_ready = true;  ///< needs to be told nothing
};

/// Those of the paper in the order of its tables, then others.
const std::vector<DetectorType>& table() {
  static const std::vector<DetectorType> rows = {
#ifdef SUNLIT_SIFT
      {"sift", makeSift},
#endif
#ifdef SUNLIT_SURF
      {"surf", makeSurf},
#endif
      {"orb", makeOrb},           {"brisk", makeBrisk}, {"akaze", makeAkaze}, {"kaze", makeKaze},
#ifdef SUNLIT_SIFT
      {"rootsift", makeRootSift},
#endif
      {"onnx", makeOnnx, false}};
  return rows;
}

/// A detector in front of which something stands. Subclasses say what.
class Fronted : public Detector {
 public:
  explicit Fronted(std::unique_ptr<Detector> detector) : detector_(std::move(detector)) {}
  int norm() const override { return detector_->norm(); }
  bool histograms() const override { return detector_->histograms(); }
  cv::Mat seen(const Picture& picture) const override { return detector_->seen(picture); }
  cv::Ptr<cv::Feature2D> make() const override { return detector_->make(); }
  std::string version() const override { return detector_->version(); }
  /// A preprocessing is known by the picture that is seen, a name by nothing.
  std::string identity() const override { return detector_->identity(); }

 protected:
  std::unique_ptr<Detector> detector_;
};

class Preprocessed : public Fronted {
 public:
  Preprocessed(std::unique_ptr<Detector> detector, std::string name,
               std::unique_ptr<Preprocessing> preprocessing)
      : Fronted(std::move(detector)), name_(std::move(name)), preprocessing_(std::move(preprocessing)) {}
  std::unique_ptr<Detector> clone() const override {
    return std::make_unique<Preprocessed>(detector_->clone(), name_, preprocessing_->clone());
  }
  std::vector<Field> fields() override {
    return joined({detector_->fields(), under(name_, preprocessing_->fields())});
  }
  cv::Mat seen(const Picture& picture) const override { return preprocessing_->of(picture); }

 private:
  std::string name_;
  std::unique_ptr<Preprocessing> preprocessing_;
};

/// A detector that says what it is.
class Own : public Fronted {
 public:
  Own(DetectorKind kind, std::unique_ptr<Detector> detector)
      : Fronted(std::move(detector)), kind_(std::move(kind)) {}
  std::unique_ptr<Detector> clone() const override {
    return std::make_unique<Own>(kind_, detector_->clone());
  }
  std::vector<Field> fields() override {
    std::vector<Field> rows = ownDetectorFields(kind_);
    if (kind_.preprocessing.empty()) rows.pop_back();  // so that older folders are taken up again
    return joined({rows, detector_->fields()});
  }

 private:
  DetectorKind kind_;
};

/// Through nothing where `preprocessing` is empty.
std::unique_ptr<Detector> seenThrough(const std::string& preprocessing, std::unique_ptr<Detector> detector) {
  if (preprocessing.empty()) return detector;
  return preprocessed(std::move(detector), preprocessing, makePreprocessing(preprocessing));
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

const std::vector<AbsentDetector>& absentDetectors() {
  static const std::vector<AbsentDetector> rows = {
#ifndef SUNLIT_SIFT
      {"sift", "OpenCV must be 4.4 or newer for it, and is " CV_VERSION},
      {"rootsift", "OpenCV must be 4.4 or newer for it, and is " CV_VERSION},
#endif
#ifndef SUNLIT_SURF
      {"surf", "option SUNLIT_SURF is off"},
#endif
  };
  return rows;
}

const std::vector<std::string>& readyDetectorTypes() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> ready;
    for (const DetectorType& type : table()) {
      if (type.is_ready) ready.push_back(type.name);
    }
    return ready;
  }();
  return names;
}

DetectorKind DetectorKind::named(const std::string& name) {
  const std::size_t plus = name.find('+');
  if (plus == std::string::npos) return {name, ""};
  return {name.substr(0, plus), name.substr(plus + 1)};
}

std::vector<std::string> detectorNames(const std::vector<std::string>& types) {
  std::vector<std::string> names = types;
  for (const std::string& type : types) {
    for (const std::string& preprocessing : preprocessingNames()) names.push_back(type + "+" + preprocessing);
  }
  return names;
}

std::unique_ptr<Detector> makeDetector(const std::string& type) {
  for (const DetectorType& row : table()) {
    if (row.name == type) return row.make();
  }
  std::string allowed = "one of " + textOf(detectorTypes());
  for (const AbsentDetector& absent : absentDetectors()) {
    if (absent.type == type) allowed += ", as this build has no " + type + " (" + absent.why + ")";
  }
  refuse("detector", '"' + type + '"', allowed);
}

std::unique_ptr<Detector> makeDetector(const DetectorKind& kind) {
  return seenThrough(kind.preprocessing, makeDetector(kind.type));
}

std::unique_ptr<Detector> preprocessed(std::unique_ptr<Detector> detector, const std::string& name,
                                       std::unique_ptr<Preprocessing> preprocessing) {
  return std::make_unique<Preprocessed>(std::move(detector), name, std::move(preprocessing));
}

std::vector<Field> ownDetectorFields(const DetectorKind& kind) {
  return {{"type",
           OwnForm{kind.type},
           "",
           {},
           "one of " + textOf(detectorTypes()) +
               ", or a class of a package, as example_detectors/Corners; required"},
          {"preprocessing",
           OwnForm{kind.preprocessing.empty() ? kNoPreprocessing : kind.preprocessing},
           "",
           {},
           std::string(kNoPreprocessing) + " or one of " + textOf(preprocessingNames()) +
               ": what the picture is made into before the detector looks at it"}};
}

std::unique_ptr<Detector> makeOwnDetector(const DetectorKind& kind) {
  return makeOwnDetector(kind, makeDetector(kind.type));
}

std::unique_ptr<Detector> makeOwnDetector(const DetectorKind& kind, std::unique_ptr<Detector> of_type) {
  return std::make_unique<Own>(kind, seenThrough(kind.preprocessing, std::move(of_type)));
}

std::string Detector::identity() const {
  std::string text = version();
  if (text.empty()) return text;
  const std::unique_ptr<Detector> same = clone();  // which gives its rows
  for (const Field& row : same->fields()) {
    const Field::Value value = row.value();
    char exactly[32];
    const auto* const number = std::get_if<double>(&value);
    if (number != nullptr) std::snprintf(exactly, sizeof exactly, "%a", *number);
    text += "\n" + row.key + ": " + (number != nullptr ? exactly : textOf(value));
  }
  return text;
}

Features detectFeatures(const Detector& detector, const Picture& picture) {
  return detectFeatures(*detector.make(), detector.seen(picture));
}

Features detectFeatures(cv::Feature2D& worker, const cv::Mat& seen) {
  Features features;
  try {
    worker.detectAndCompute(seen, cv::noArray(), features.key_points, features.descriptors);
  } catch (const cv::Exception& error) {
    throw std::runtime_error(worker.getDefaultName() + " finds no features in a picture of " +
                             std::to_string(seen.cols) + "×" + std::to_string(seen.rows) +
                             " px: " + error.err);
  }
  return features;
}

}  // namespace sunlit::evaluate
