#include <utility>

#include "evaluate/features/detectors.h"
#include "evaluate/features/root_sift.h"

namespace sunlit::evaluate {
namespace {

/// cv::SIFT.
class Sift : public Detector {
 public:
  std::unique_ptr<Detector> clone() const override { return std::make_unique<Sift>(*this); }
  std::string version() const override { return "sift"; }
  std::vector<Field> fields() override {
    return {{"n_features", &n_features_, "", {0, kMostFeatures}, "best ones kept; 0: all"},
            {"n_octave_layers", &n_octave_layers_, "", {1, 10}, "layers of an octave"},
            {"contrast_threshold", &contrast_threshold_, "", {0, 1}, "weaker ones are left out"},
            {"edge_threshold", &edge_threshold_, "", {1e-3, 1e6}, "more edge-like ones are left out"},
            {"sigma", &sigma_, "px", {0.1, 10}, "of the Gaussian of octave 0"}};
  }
  int norm() const override { return cv::NORM_L2; }
  bool histograms() const override { return true; }
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

class RootSiftWorker : public cv::Feature2D {
 public:
  explicit RootSiftWorker(cv::Ptr<cv::Feature2D> sift) : sift_(std::move(sift)) {}
  int descriptorSize() const override { return sift_->descriptorSize(); }
  int descriptorType() const override { return CV_32F; }
  int defaultNorm() const override { return cv::NORM_L2; }
  bool empty() const override { return false; }

  void detectAndCompute(cv::InputArray image, cv::InputArray mask, std::vector<cv::KeyPoint>& keypoints,
                        cv::OutputArray descriptors, bool use_provided_keypoints) override {
    cv::Mat bytes;
    sift_->detectAndCompute(image, mask, keypoints, descriptors.needed() ? bytes : cv::noArray(),
                            use_provided_keypoints);
    if (descriptors.needed()) descriptors.assign(rootSift(bytes));
  }

 private:
  cv::Ptr<cv::Feature2D> sift_;
};

class RootSift : public Sift {
 public:
  std::unique_ptr<Detector> clone() const override { return std::make_unique<RootSift>(*this); }
  std::string version() const override { return "rootsift"; }
  bool histograms() const override { return false; }  // roots of them
  cv::Ptr<cv::Feature2D> make() const override { return cv::makePtr<RootSiftWorker>(Sift::make()); }
};

}  // namespace

std::unique_ptr<Detector> makeRootSift() {
  return std::make_unique<RootSift>();
}

std::unique_ptr<Detector> makeSift() {
  return std::make_unique<Sift>();
}

}  // namespace sunlit::evaluate
