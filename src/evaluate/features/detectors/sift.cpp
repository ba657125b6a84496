#include "evaluate/features/detectors.h"

namespace sunlit::evaluate {
namespace {

/// cv::SIFT.
class Sift : public Detector {
 public:
  std::unique_ptr<Detector> clone() const override { return std::make_unique<Sift>(*this); }
  std::vector<Field> fields() override {
    return {{"n_features", &n_features_, "", {0, kMostFeatures}, "best ones kept; 0: all"},
            {"n_octave_layers", &n_octave_layers_, "", {1, 10}, "layers of an octave"},
            {"contrast_threshold", &contrast_threshold_, "", {0, 1}, "weaker ones are left out"},
            {"edge_threshold", &edge_threshold_, "", {1e-3, 1e6}, "more edge-like ones are left out"},
            {"sigma", &sigma_, "px", {0.1, 10}, "of the Gaussian of octave 0"}};
  }
  int norm() const override { return cv::NORM_L2; }
  /// Its elements are whole numbers up to 255; as bytes they are the same numbers in a quarter of the memory.
  cv::Ptr<cv::Feature2D> make() const override {
    return cv::SIFT::create(n_features_, n_octave_layers_, contrast_threshold_, edge_threshold_, sigma_,
                            CV_8U);
  }

 private:
  int n_features_ = 0;
  int n_octave_layers_ = 3;
  double contrast_threshold_ = 0.04;
  double edge_threshold_ = 10.0;
  double sigma_ = 1.6;
};

}  // namespace

std::unique_ptr<Detector> makeSift() {
  return std::make_unique<Sift>();
}

}  // namespace sunlit::evaluate
