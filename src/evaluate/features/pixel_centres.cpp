#include "evaluate/features/pixel_centres.h"

#include <utility>

namespace sunlit::evaluate {
namespace {

class Centred : public cv::Feature2D {
 public:
  Centred(cv::Ptr<cv::Feature2D> worker, LevelOf level_of)
      : worker_(std::move(worker)), level_of_(std::move(level_of)) {}
  int descriptorSize() const override { return worker_->descriptorSize(); }
  int descriptorType() const override { return worker_->descriptorType(); }
  int defaultNorm() const override { return worker_->defaultNorm(); }
  bool empty() const override { return worker_->empty(); }
  cv::String getDefaultName() const override { return worker_->getDefaultName(); }

  void detectAndCompute(cv::InputArray image, cv::InputArray mask, std::vector<cv::KeyPoint>& keypoints,
                        cv::OutputArray descriptors, bool use_provided_keypoints) override {
    CV_Assert(!use_provided_keypoints);
    worker_->detectAndCompute(image, mask, keypoints, descriptors, false);
    const cv::Size picture = image.size();
    for (cv::KeyPoint& key_point : keypoints) {
      const PyramidLevel level = level_of_(key_point.octave, picture);
      const auto moved = [&](float told, double of_picture, double of_level) {
        const double at = (static_cast<double>(told) - level.offset) / level.scale;
        return static_cast<float>((at + 0.5) * of_picture / of_level - 0.5);
      };
      key_point.pt = {moved(key_point.pt.x, picture.width, level.size.width),
                      moved(key_point.pt.y, picture.height, level.size.height)};
    }
  }

 private:
  cv::Ptr<cv::Feature2D> worker_;
  LevelOf level_of_;
};

}  // namespace

cv::Ptr<cv::Feature2D> atPixelCentres(cv::Ptr<cv::Feature2D> worker, LevelOf level_of) {
  return cv::makePtr<Centred>(std::move(worker), std::move(level_of));
}

}  // namespace sunlit::evaluate
