/// What a camera saw along a drive, kept to be recognised: key frames of features whose places are known.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sunlit/evaluate/features/features.h"
#include "sunlit/evaluate/posed_view.h"

namespace sunlit::evaluate {

/// Lengths that differ by this part are equal: places of a path of whole steps are whole steps apart, but for
/// the rounding of coordinates and sums, which must not decide what is far enough, and what nearer.
constexpr double kLengthRounding = 1e-6;

/// Of one detector.
struct KeyFrame {
  Eigen::Isometry3d map_from_optical = Eigen::Isometry3d::Identity();
  std::vector<Eigen::Vector3d> points;  ///< in `map`, m, one a descriptor
  cv::Mat descriptors;                  ///< one row each, see compactDescriptors()
};

/// Of which picture a key frame was made.
struct KeyFrameOrigin {
  std::string stream;
  std::int64_t pose = -1;
};

/// Where the features of `view` lie in `map`, m, as its depth tells; NaN where it does not, as of the sky.
std::vector<Eigen::Vector3d> pointsOf(const PosedView& view, const Features& features);

/// Of those features whose `points`, one a feature, are known.
KeyFrame keyFrameOf(const Eigen::Isometry3d& map_from_optical, const Features& features,
                    const std::vector<Eigen::Vector3d>& points);
/// By pointsOf(), of straightOnes() alone: so far from the axis as queries are looked for.
KeyFrame keyFrameOf(const PosedView& view, const Features& features);

/// What a map made of several streams is called: "h04+h12".
std::string nameOfMap(const std::vector<std::string>& streams);

/// Bytes of its points and descriptors.
std::size_t bytesOf(const KeyFrame& frame);

/// As CV_8U where every number is a whole one from 0 to 255, as all of SIFT's are: a quarter of the memory
/// and time, and the same distances to the bit. Else the same matrix.
cv::Mat compactDescriptors(const cv::Mat& descriptors);

/// Tells which poses of a drive become key frames: the first, and then each at which the path from pose to
/// pose has grown by at least `spacing_m` (≥ 0) since the last one.
class KeyFrameSpacing {
 public:
  explicit KeyFrameSpacing(double spacing_m) : spacing_m_(spacing_m) {}
  bool takes(const Eigen::Vector3d& position);

 private:
  double spacing_m_;
  double since_last_m_ = 0.0;
  std::optional<Eigen::Vector3d> before_;
};

}  // namespace sunlit::evaluate
