#include <cmath>
#include <opencv2/core.hpp>

#include "evaluate/features/preprocessings.h"

namespace sunlit::evaluate {
namespace {

class Gamma : public Preprocessing {
 public:
  std::unique_ptr<Preprocessing> clone() const override { return std::make_unique<Gamma>(*this); }
  std::vector<Field> fields() override {
    return {{"exponent", &exponent_, "", {0.1, 10}, "of grey levels; below 1 the dark becomes brighter"}};
  }
  cv::Mat of(const Picture& picture) const override {
    constexpr double kWhite = 255.0;
    cv::Mat levels(1, 256, CV_8U);
    for (int v = 0; v < levels.cols; ++v)
      levels.at<uchar>(v) = static_cast<uchar>(std::lround(kWhite * std::pow(v / kWhite, exponent_)));
    cv::Mat curved;
    cv::LUT(picture.grey, levels, curved);
    return curved;
  }

 private:
  double exponent_ = 0.5;
};

}  // namespace

std::unique_ptr<Preprocessing> makeGamma() {
  return std::make_unique<Gamma>();
}

}  // namespace sunlit::evaluate
