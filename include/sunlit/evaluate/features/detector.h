/// What every detector of features can.
#pragma once

#include <memory>
#include <opencv2/features2d.hpp>
#include <string>
#include <vector>

#include "sunlit/evaluate/features/features.h"
#include "sunlit/quantity/field.h"

namespace sunlit::evaluate {

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
  /// What does the work, with the present parameters, which are within their ranges. What it finds in a grey
  /// picture is the same to the bit for any number of threads. Not to be shared between threads: it may keep
  /// buffers.
  virtual cv::Ptr<cv::Feature2D> make() const = 0;
};

/// `sift surf orb brisk akaze kaze rootsift`; surf only where it was built in.
const std::vector<std::string>& detectorTypes();
/// With its usual parameters. Throws std::invalid_argument for what is not one of detectorTypes().
std::unique_ptr<Detector> makeDetector(const std::string& type);
/// The same for a name of one's own: what it is stands in a row `type` above the others.
std::unique_ptr<Detector> makeTypedDetector(const std::string& type);

/// Key points and descriptors of a grey picture.
Features detectFeatures(const Detector& detector, const cv::Mat& grey);

}  // namespace sunlit::evaluate
