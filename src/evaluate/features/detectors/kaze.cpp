#include "evaluate/features/detectors.h"

namespace sunlit::evaluate {
namespace {

/// cv::KAZE.
class Kaze : public Detector {
 public:
  std::unique_ptr<Detector> clone() const override { return std::make_unique<Kaze>(*this); }
  std::string version() const override { return "kaze"; }
  std::vector<Field> fields() override {
    return {{"extended", &extended_, "", {}, "128 numbers a descriptor instead of 64"},
            {"upright", &upright_, "", {}, "no orientation"},
            {"threshold", &threshold_, "", {0, 1}, "that the determinant of the Hessian exceeds"},
            {"n_octaves", &n_octaves_, "", {1, 8}, "doublings of the scale"},
            {"n_octave_layers", &n_octave_layers_, "", {1, 16}, "layers of an octave"},
            {"diffusivity", choiceOf(&diffusivity_, kDiffusivities), "", {}, kDiffusivityDoc}};
  }
  int norm() const override { return cv::NORM_L2; }
  cv::Ptr<cv::Feature2D> make() const override {
    return cv::KAZE::create(extended_, upright_, static_cast<float>(threshold_), n_octaves_, n_octave_layers_,
                            diffusivity_);
  }

 private:
  bool extended_ = false;
  bool upright_ = false;
  double threshold_ = 0.001;
  int n_octaves_ = 4;
  int n_octave_layers_ = 4;
  cv::KAZE::DiffusivityType diffusivity_ = cv::KAZE::DIFF_PM_G2;
};

}  // namespace

std::unique_ptr<Detector> makeKaze() {
  return std::make_unique<Kaze>();
}

}  // namespace sunlit::evaluate
