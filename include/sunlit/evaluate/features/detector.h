/// What every detector of features can.
#pragma once

#include <memory>
#include <opencv2/features2d.hpp>
#include <string>
#include <vector>

#include "sunlit/evaluate/features/features.h"
#include "sunlit/evaluate/features/preprocessing.h"
#include "sunlit/evaluate/picture.h"
#include "sunlit/quantity/field.h"

namespace sunlit::evaluate {

/// What descriptors are to whoever compares them.
struct DescriptorSpace {
  int norm = 0;  ///< a cv::NormTypes
  bool histograms = false;
};

/// What finds key points and describes them, with its parameters.
///
/// To add one: a file like src/evaluate/features/detectors/sift.cpp, and its row in the table of
/// detector.cpp.
class Detector {
 public:
  virtual ~Detector() = default;
  virtual std::unique_ptr<Detector> clone() const = 0;
  /// Its parameters, rows that point into it.
  virtual std::vector<Field> fields() = 0;
  /// How its descriptors are compared: a cv::NormTypes.
  virtual int norm() const = 0;
  /// Whether they are histograms, as SIFT's.
  virtual bool histograms() const { return false; }
  DescriptorSpace space() const { return {norm(), histograms()}; }
  /// The grey picture that it looks at, CV_8UC1.
  virtual cv::Mat seen(const Picture& picture) const { return picture.grey; }
  /// What does the work, with the present parameters, which are within their ranges. What it finds in a grey
  /// picture is the same to the bit for any number of threads. Not to be shared between threads: it may keep
  /// buffers.
  virtual cv::Ptr<cv::Feature2D> make() const = 0;
  /// What its features may be kept under for other runs, beside its parameters and the picture that it sees:
  /// who it is, and in which version. Empty: they are not kept.
  virtual std::string version() const = 0;
  /// That and its parameters; empty where version() is.
  virtual std::string identity() const;
};

/// `sift surf orb brisk akaze kaze rootsift onnx`, but for absentDetectors().
const std::vector<std::string>& detectorTypes();

/// A detector that other builds have.
struct AbsentDetector {
  std::string type;
  std::string why;
};
const std::vector<AbsentDetector>& absentDetectors();

/// Those that find features with their usual parameters: all but `onnx`, which needs a network.
const std::vector<std::string>& readyDetectorTypes();

/// A detector, and what it sees the picture through.
struct DetectorKind {
  std::string type;           ///< one of detectorTypes()
  std::string preprocessing;  ///< one of preprocessingNames(); empty: none
  /// As command lines have it: `sift`, or `sift+clahe`. Nothing is checked.
  static DetectorKind named(const std::string& name);
};

/// `types`, and then each of them with each preprocessing, as DetectorKind::named() takes them.
std::vector<std::string> detectorNames(const std::vector<std::string>& types = detectorTypes());

/// With its usual parameters. Throws std::invalid_argument for a kind that there is not.
std::unique_ptr<Detector> makeDetector(const std::string& type);
std::unique_ptr<Detector> makeDetector(const DetectorKind& kind);
/// `detector`, which looks at what `preprocessing` makes of a picture. Its rows are joined by those of the
/// preprocessing under `name`.
std::unique_ptr<Detector> preprocessed(std::unique_ptr<Detector> detector, const std::string& name,
                                       std::unique_ptr<Preprocessing> preprocessing);
/// What a detector under a name of one's own is told beside the parameters of its type and preprocessing:
/// rows `type` and `preprocessing`.
constexpr const char* kNoPreprocessing = "none";
std::vector<Field> ownDetectorFields(const DetectorKind& kind);
/// For a name of one's own: what it is stands in a row `type` above the others, and where there is one, in a
/// row `preprocessing`.
std::unique_ptr<Detector> makeOwnDetector(const DetectorKind& kind);

/// Throws std::runtime_error where OpenCV refuses the picture, such as one too small for BRISK.
Features detectFeatures(const Detector& detector, const Picture& picture);
/// The same by what a detector made, in the picture that it sees.
Features detectFeatures(cv::Feature2D& worker, const cv::Mat& seen);

}  // namespace sunlit::evaluate
