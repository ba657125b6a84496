#include "sunlit/evaluate/localise/map.h"

#include <cmath>
#include <opencv2/core.hpp>

namespace sunlit::evaluate {

std::vector<Eigen::Vector3d> pointsOf(const PosedView& view, const Features& features) {
  std::vector<Eigen::Vector3d> points;
  for (const cv::KeyPoint& key_point : features.key_points) {
    const auto point = pointAt(view, {key_point.pt.x, key_point.pt.y});
    points.push_back(point.value_or(Eigen::Vector3d::Constant(std::nan(""))));
  }
  return points;
}

KeyFrame keyFrameOf(const Eigen::Isometry3d& map_from_optical, const Features& features,
                    const std::vector<Eigen::Vector3d>& points) {
  KeyFrame frame;
  frame.map_from_optical = map_from_optical;
  cv::Mat chosen;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) continue;
    frame.points.push_back(points[i]);
    chosen.push_back(features.descriptors.row(static_cast<int>(i)));
  }
  frame.descriptors = compactDescriptors(chosen);
  return frame;
}

KeyFrame keyFrameOf(const PosedView& view, const Features& features) {
  const Features seen = straightOnes(features, view.camera).seen;
  return keyFrameOf(view.map_from_optical, seen, pointsOf(view, seen));
}

std::string nameOfMap(const std::vector<std::string>& streams) {
  std::string name;
  for (const std::string& stream : streams) name += (name.empty() ? "" : "+") + stream;
  return name;
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
  if (!is_first && since_last_m_ < spacing_m_ * (1.0 - kLengthRounding)) return false;
  since_last_m_ = 0.0;
  return true;
}

}  // namespace sunlit::evaluate
