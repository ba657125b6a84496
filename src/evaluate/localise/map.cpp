#include "sunlit/evaluate/localise/map.h"

#include <cmath>
#include <opencv2/core.hpp>

namespace sunlit::evaluate {
namespace {

/// A path of whole steps must not lose a key frame by the rounding of their lengths' sum.
constexpr double kRounding = 1e-6;

}  // namespace

KeyFrame keyFrameOf(const PosedView& view, const Features& features) {
  KeyFrame frame;
  frame.map_from_optical = view.map_from_optical;
  cv::Mat chosen;
  for (std::size_t i = 0; i < features.key_points.size(); ++i) {
    const cv::Point2f& pixel = features.key_points[i].pt;
    const auto point = pointAt(view, {pixel.x, pixel.y});
    if (!point) continue;
    frame.points.push_back(*point);
    chosen.push_back(features.descriptors.row(static_cast<int>(i)));
  }
  frame.descriptors = compactDescriptors(chosen);
  return frame;
}

std::size_t bytesOf(const KeyFrame& frame) {
  return frame.points.size() * sizeof(Eigen::Vector3d) +
         frame.descriptors.total() * frame.descriptors.elemSize();
}

cv::Mat compactDescriptors(const cv::Mat& descriptors) {
  if (descriptors.type() != CV_32FC1) return descriptors;
  for (int i = 0; i < descriptors.rows; ++i) {
    const float* const row = descriptors.ptr<float>(i);
    for (int k = 0; k < descriptors.cols; ++k) {
      if (!(row[k] >= 0.0F && row[k] <= 255.0F && row[k] == std::floor(row[k]))) return descriptors;
    }
  }
  cv::Mat bytes;
  descriptors.convertTo(bytes, CV_8U);
  return bytes;
}

bool KeyFrameSpacing::takes(const Eigen::Vector3d& position) {
  const bool is_first = !before_;
  if (!is_first) since_last_m_ += (position - *before_).norm();
  before_ = position;
  if (!is_first && since_last_m_ < spacing_m_ * (1.0 - kRounding)) return false;
  since_last_m_ = 0.0;
  return true;
}

}  // namespace sunlit::evaluate
