#include <opencv2/imgproc.hpp>

#include "evaluate/features/preprocessings.h"

namespace sunlit::evaluate {
namespace {

class Clahe : public Preprocessing {
 public:
  std::unique_ptr<Preprocessing> clone() const override { return std::make_unique<Clahe>(*this); }
  std::vector<Field> fields() override {
    return {
        {"clip_limit",
         &clip_limit_,
         "",
         {1, 256},
         "how often a level may be there, times the mean of all levels: how steep contrast may become"},
        {"tiles", &tiles_, "", {1, 64}, "along each side of the picture, each with a histogram of its own"}};
  }
  cv::Mat of(const Picture& picture) const override {
    cv::Mat equalised;  // a worker keeps buffers, so each call has its own
    cv::createCLAHE(clip_limit_, {tiles_, tiles_})->apply(picture.grey, equalised);
    return equalised;
  }

 private:
  double clip_limit_ = 2.0;  // of OpenCV's tutorial; its own default, 40, hardly limits
  int tiles_ = 8;
};

}  // namespace

std::unique_ptr<Preprocessing> makeClahe() {
  return std::make_unique<Clahe>();
}

}  // namespace sunlit::evaluate
