#include "evaluate/features/detectors.h"

namespace sunlit::evaluate {
namespace {

/// cv::BRISK.
class Brisk : public Detector {
 public:
  std::unique_ptr<Detector> clone() const override { return std::make_unique<Brisk>(*this); }
  std::string version() const override { return "brisk"; }
  std::vector<Field> fields() override {
    return {{"threshold", &threshold_, "grey levels", {1, 255}, "of AGAST"},
            {"n_octaves", &n_octaves_, "", {0, 9}, "0: one scale"},
            {"pattern_scale", &pattern_scale_, "", {0.1, 10}, "of the descriptor's pattern"}};
  }
  int norm() const override { return cv::NORM_HAMMING; }
  cv::Ptr<cv::Feature2D> make() const override {
    return cv::BRISK::create(threshold_, n_octaves_, static_cast<float>(pattern_scale_));
  }

 private:
  int threshold_ = 30;
  int n_octaves_ = 3;
  double pattern_scale_ = 1.0;
};

}  // namespace

std::unique_ptr<Detector> makeBrisk() {
  return std::make_unique<Brisk>();
}

}  // namespace sunlit::evaluate
