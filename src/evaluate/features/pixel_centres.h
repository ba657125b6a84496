/// Key points by the convention of all that is measured here: the centre of the top left pixel is (0, 0).
#pragma once

#include <functional>
#include <opencv2/features2d.hpp>

namespace sunlit::evaluate {

/// A level of a detector's pyramid, made of the picture by cv::resize(), which keeps the borders of both on
/// each other: the centre of pixel x of the level is at (x + 1/2) · width of the picture / width of the level
/// − 1/2 of the picture. The detector takes it to be at scale · x + offset.
struct PyramidLevel {
  cv::Size2d size;
  double scale = 1.0;
  double offset = 0.0;
};

/// By cv::KeyPoint::octave, for a picture of that size.
using LevelOf = std::function<PyramidLevel(int octave, const cv::Size& picture)>;

/// `worker` with its key points moved to where they are in the picture; all else is as it finds it. Key
/// points cannot be provided to it.
cv::Ptr<cv::Feature2D> atPixelCentres(cv::Ptr<cv::Feature2D> worker, LevelOf level_of);

}  // namespace sunlit::evaluate
