/// A detector of a researcher's own: a class in a package of its own, found by name at run time.
#pragma once

#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "sunlit/evaluate/features/detector.h"
#include "sunlit/quantity/field.h"

namespace sunlit::evaluate {

/// What such a class is derived from. README.md tells how it is built and named; test/example_detectors is
/// one.
///
/// - One object works in one thread at a time; several work at once, in a thread each, so they share nothing
///   that changes. Each has the parameters of the first.
/// - What is found depends on the picture and the parameters alone: the same bits in every run, whatever was
///   found before, and for any number of threads.
/// - Whatever goes wrong is thrown, as a std::exception whose what() says in one line what it is. Pairs of
///   that picture then count as failed, and it is not localised by it; nothing else is lost.
/// - A result that breaks what is said below is refused likewise.
class DetectorPlugin {
 public:
  virtual ~DetectorPlugin() = default;
  /// Its parameters, rows that point into it, with unit and range; keys are words of small letters, digits
  /// and _, but `type`, `preprocessing`, and names of preprocessings.
  virtual std::vector<Field> fields() { return {}; }
  /// Key points in `grey`, CV_8UC1, not empty, which stays as it is. In px, the middle of the top left pixel
  /// is (0, 0): from −0.5 to less than width − 0.5, and so down.
  virtual std::vector<cv::KeyPoint> detect(const cv::Mat& grey) = 0;
  /// A row for each of `key_points`, which come from detect() of the same picture and may be dropped or
  /// changed here: CV_8U, or CV_32F of finite numbers.
  virtual cv::Mat describe(const cv::Mat& grey, std::vector<cv::KeyPoint>& key_points) = 0;
  /// How descriptors are compared: cv::NORM_L1 or NORM_L2, or of bits, CV_8U, NORM_HAMMING or NORM_HAMMING2.
  virtual int norm() const = 0;
  /// Lets features be kept on disk for other runs: to be changed whenever other ones are found than before.
  /// Empty: found anew each time.
  virtual std::string version() const { return {}; }
};

/// Makes an object with its usual parameters.
using DetectorPluginFactory = std::function<std::shared_ptr<DetectorPlugin>()>;

/// The detector of what `make` makes; `name`, such as "example_detectors/Corners", stands in all messages.
/// Throws std::invalid_argument where it throws, or gives a norm or a parameter that breaks the rules above.
std::unique_ptr<Detector> makePluginDetector(const std::string& name, DetectorPluginFactory make);

/// As makeOwnDetector(kind), of a detector of that type that others have made.
std::unique_ptr<Detector> makeOwnDetector(const DetectorKind& kind, std::unique_ptr<Detector> of_type);

}  // namespace sunlit::evaluate
