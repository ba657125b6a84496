#include "evaluate/features/detectors.h"
#include "evaluate/features/pixel_centres.h"

namespace sunlit::evaluate {
namespace {

/// Octave by octave half of the one before, and between two of them two thirds of the picture, and half of
/// that, each rounded down to whole pixels, though taken to be of just that scale.
PyramidLevel levelOfBrisk(int octave, const cv::Size& picture) {
  const bool is_between = octave % 2 == 1;
  cv::Size size = is_between ? cv::Size(picture.width / 3 * 2, picture.height / 3 * 2) : picture;
  double scale = is_between ? 1.5 : 1.0;
  for (int i = 0; i < octave / 2; ++i) {
    size = {size.width / 2, size.height / 2};
    scale *= 2.0;
  }
  return {size, scale, 0.5 * (scale - 1.0)};
}

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
    return atPixelCentres(cv::BRISK::create(threshold_, n_octaves_, static_cast<float>(pattern_scale_)),
                          levelOfBrisk);
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
