#include "sunlit/evaluate/features/surf.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "evaluate/features/surf_descriptor.h"
#include "evaluate/features/surf_maxima.h"
#include "evaluate/features/surf_orientation.h"

namespace sunlit::evaluate {
namespace {

constexpr float kUprightAngleDeg = 270;
constexpr float kRemoved = -1;  // size of a key point that is to be taken out

class Surf : public cv::Feature2D {
 public:
  explicit Surf(const SurfOptions& options) : options_(options), descriptor_(options.extended) {}

  int descriptorSize() const override { return descriptor_.size(); }
  int descriptorType() const override { return CV_32F; }
  int defaultNorm() const override { return cv::NORM_L2; }
  bool empty() const override { return false; }
  cv::String getDefaultName() const override { return Feature2D::getDefaultName() + ".SURF"; }

  void detectAndCompute(cv::InputArray image, cv::InputArray mask, std::vector<cv::KeyPoint>& keypoints,
                        cv::OutputArray descriptors, bool use_provided_keypoints) override;

 private:
  std::vector<cv::KeyPoint> detectMaxima(const cv::Mat& integral, const cv::Mat& mask) const;
  void orient(const cv::Mat& integral, std::vector<cv::KeyPoint>& keypoints) const;
  void describe(const cv::Mat& grey, const std::vector<cv::KeyPoint>& keypoints, cv::Mat& descriptors) const;

  SurfOptions options_;
  surf::Orientation orientation_;
  surf::Descriptor descriptor_;
};

std::vector<cv::KeyPoint> Surf::detectMaxima(const cv::Mat& integral, const cv::Mat& mask) const {
  cv::Mat mask_integral;
  if (!mask.empty()) {
    const cv::Mat ones = cv::min(mask, 1);
    cv::integral(ones, mask_integral, CV_32S);
  }
  const surf::MaximaInput input{integral, mask_integral, static_cast<float>(options_.hessian_threshold)};
  std::vector<cv::KeyPoint> found;
  for (int octave = 0; octave < options_.octaves; ++octave) {
    // The first triple needs the third filter; larger octaves need larger ones still.
    const int needed = surf::filterSize(octave, 2);
    if (needed > std::min(integral.rows, integral.cols) - 1) break;
    const surf::IntegralPlanes planes(integral, 1 << octave);
    std::vector<surf::HessianLayer> layers;
    for (int layer = 0; layer < options_.octave_layers + 2; ++layer) {
      layers.push_back(surf::hessianLayer(planes, surf::filterSize(octave, layer)));
    }
    for (int layer = 1; layer <= options_.octave_layers; ++layer) {
      const auto more =
          surf::findMaxima({&layers[layer - 1], &layers[layer], &layers[layer + 1], octave}, input);
      found.insert(found.end(), more.begin(), more.end());
    }
  }
  surf::sortByResponse(found);
  if (!mask.empty()) cv::KeyPointsFilter::runByPixelsMask(found, mask);
  return found;
}

void Surf::orient(const cv::Mat& integral, std::vector<cv::KeyPoint>& keypoints) const {
  const tbb::blocked_range<std::size_t> all(0, keypoints.size(), 32);
  tbb::parallel_for(all, [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      cv::KeyPoint& point = keypoints[k];
      const int side = surf::Orientation::waveletSize(point.size);
      if (integral.rows < side || integral.cols < side) {
        point.size = kRemoved;
      } else if (options_.upright) {
        point.angle = kUprightAngleDeg;
      } else if (const auto angle = orientation_.of(point, integral)) {
        point.angle = *angle;
      } else {
        point.size = kRemoved;
      }
    }
  });
  keypoints.erase(std::remove_if(keypoints.begin(), keypoints.end(),
                                 [](const cv::KeyPoint& point) { return point.size <= 0; }),
                  keypoints.end());
}

void Surf::describe(const cv::Mat& grey, const std::vector<cv::KeyPoint>& keypoints,
                    cv::Mat& descriptors) const {
  const surf::CellImage cells(grey);
  const tbb::blocked_range<std::size_t> all(0, keypoints.size(), 16);
  tbb::parallel_for(all, [&](const tbb::blocked_range<std::size_t>& range) {
    surf::PatchCutter cutter(cells);
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      const cv::KeyPoint& point = keypoints[k];
      const surf::Patch& patch = options_.upright ? cutter.upright(point) : cutter.turned(point, point.angle);
      descriptor_.of(patch, descriptors.ptr<float>(static_cast<int>(k)));
    }
  });
}

void Surf::detectAndCompute(cv::InputArray image, cv::InputArray mask, std::vector<cv::KeyPoint>& keypoints,
                            cv::OutputArray descriptors, bool use_provided_keypoints) {
  CV_Assert(!image.empty() && image.depth() == CV_8U &&
            (image.channels() == 1 || image.channels() == 3 || image.channels() == 4));
  CV_Assert(descriptors.needed() || !use_provided_keypoints);
  cv::Mat grey = image.getMat();
  if (grey.channels() > 1) cv::cvtColor(grey, grey, cv::COLOR_BGR2GRAY);
  const cv::Mat allowed = mask.getMat();
  CV_Assert(allowed.empty() || (allowed.type() == CV_8U && allowed.size() == grey.size()));

  cv::Mat integral;
  cv::integral(grey, integral, CV_32S);
  if (!use_provided_keypoints) keypoints = detectMaxima(integral, allowed);
  orient(integral, keypoints);
  if (!descriptors.needed()) return;
  if (keypoints.empty()) {
    descriptors.release();
    return;
  }
  descriptors.create(static_cast<int>(keypoints.size()), descriptorSize(), CV_32F);
  cv::Mat rows = descriptors.getMat();
  describe(grey, keypoints, rows);
}

}  // namespace

cv::Ptr<cv::Feature2D> createSurf(const SurfOptions& options) {
  requireFields(options);
  return cv::makePtr<Surf>(options);
}

}  // namespace sunlit::evaluate
