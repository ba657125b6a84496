/// A picture of which it is known where it was taken, and how far away all is that it shows.
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "sunlit/evaluate/picture.h"
#include "sunlit/evaluate/view_camera.h"

namespace sunlit::evaluate {

struct PosedView {
  Picture picture;
  ViewCamera camera;
  /// The optical frame (z forward, x right, y down) in the frame that all views share.
  Eigen::Isometry3d map_from_optical = Eigen::Isometry3d::Identity();
  /// CV_32FC1, m as ViewCamera::depthOf(), at the centres of the camera's pixels; what is not finite or
  /// not above 0 shows nothing. Empty: nothing is known.
  cv::Mat depth;
};

/// Throws std::invalid_argument unless the picture, and depth where there is any, have the camera's size, and
/// depth is CV_32FC1.
void requireWhole(const PosedView& view);

/// Depth, m along z, of what is seen at `pixel`. Inverse depth is linear in pixels on a plane, so that of the
/// four pixels around is interpolated where they show one surface; else the nearest pixel tells. One surface:
/// neighbours differ in inverse depth by at most 2 %, or go on as the pixels before or behind them do, up to
/// a tenth of their difference; so nothing is made up between a pole and what is behind it, while a road
/// reaches up to the horizon. None outside the picture (−0.5 … size − 0.5) and where nothing is seen.
std::optional<double> depthAt(const cv::Mat& depth, const Eigen::Vector2d& pixel);

/// The point in `map`, m, that is seen at `pixel`; none where depthAt() gives none.
std::optional<Eigen::Vector3d> pointAt(const PosedView& view, const Eigen::Vector2d& pixel);

}  // namespace sunlit::evaluate
