#include "sunlit/evaluate/features/surf.h"

#include "evaluate/features/detectors.h"

namespace sunlit::evaluate {
namespace {

class SurfDetector : public Detector {
 public:
  std::unique_ptr<Detector> clone() const override { return std::make_unique<SurfDetector>(*this); }
  std::string version() const override { return "surf"; }
  std::vector<Field> fields() override { return fieldsOf(options_); }
  int norm() const override { return cv::NORM_L2; }
  cv::Ptr<cv::Feature2D> make() const override { return createSurf(options_); }

 private:
  SurfOptions options_;
};

}  // namespace

std::unique_ptr<Detector> makeSurf() {
  return std::make_unique<SurfDetector>();
}

}  // namespace sunlit::evaluate
