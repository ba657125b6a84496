// Networks that find features, in ONNX.
#include <opencv2/core.hpp>

#include "fuzz/reader.h"
#include "sunlit/evaluate/features/detector.h"
#include "support/onnx_file.h"
#include "support/temporary_folder.h"

namespace sunlit::fuzz {

std::vector<std::string> seeds() {
  return {brightPixelNetwork(8.0F, 1.0F)};
}

void read(const std::string& input) {
  setContent("./input.onnx", input);
  const std::unique_ptr<evaluate::Detector> detector = evaluate::makeDetector("onnx");
  fieldOf(detector->fields(), "model").setText("input.onnx", "model");
  evaluate::detectFeatures(*detector, evaluate::Picture{{}, cv::Mat::ones(16, 16, CV_8U)});
}

std::string named() {
  return "input.onnx";
}

}  // namespace sunlit::fuzz
