#include "evaluate/features/detectors.h"

namespace sunlit::evaluate {
namespace {

/// cv::ORB.
class Orb : public Detector {
 public:
  std::unique_ptr<Detector> clone() const override { return std::make_unique<Orb>(*this); }
  std::string version() const override { return "orb"; }
  std::vector<Field> fields() override {
    return {{"n_features", &n_features_, "", {1, kMostFeatures}, "best ones kept"},
            {"scale_factor", &scale_factor_, "", {1.01, 4}, "between pyramid levels"},
            {"n_levels", &n_levels_, "", {1, 32}, "of the pyramid"},
            {"edge_threshold", &edge_threshold_, "px", {1, 200}, "of border without key points"},
            {"first_level", &first_level_, "", {0, 31}, "of the pyramid that the image is put into"},
            {"wta_k", &wta_k_, "", {2, 4}, "points per element of the descriptor"},
            {"patch_size", &patch_size_, "px", {2, 200}, "of a descriptor"},
            {"fast_threshold", &fast_threshold_, "grey levels", {1, 255}, "of FAST"}};
  }
  /// Of three or four points, an element has two bits.
  int norm() const override { return wta_k_ == 2 ? cv::NORM_HAMMING : cv::NORM_HAMMING2; }
  cv::Ptr<cv::Feature2D> make() const override {
    return cv::ORB::create(n_features_, static_cast<float>(scale_factor_), n_levels_, edge_threshold_,
                           first_level_, wta_k_, cv::ORB::HARRIS_SCORE, patch_size_, fast_threshold_);
  }

 private:
  int n_features_ = 500;
  double scale_factor_ = 1.2;
  int n_levels_ = 8;
  int edge_threshold_ = 31;
  int first_level_ = 0;
  int wta_k_ = 2;
  int patch_size_ = 31;
  int fast_threshold_ = 20;
};

}  // namespace

std::unique_ptr<Detector> makeOrb() {
  return std::make_unique<Orb>();
}

}  // namespace sunlit::evaluate
