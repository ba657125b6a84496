/// Pictures so small and so levelled that a sum of absolute differences tells places apart: what SeqSLAM
/// compares (M. J. Milford, G. F. Wyeth, "SeqSLAM", ICRA 2012, section III.A).
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "sunlit/evaluate/places/place_scores.h"

namespace sunlit::evaluate {

constexpr int kThumbnailWidth = 64;   // px; sizes as OpenSeqSLAM's
constexpr int kThumbnailHeight = 32;  // px
constexpr int kPatchSide = 8;         // px

/// A picture by its contrasts: in each square patch (x − μ)/σ, σ divided by n − 1, and 0 where σ is 0.
struct Thumbnail {
  /// CV_16SC1, kThumbnailHeight × kThumbnailWidth, in steps of 1/4096, which hold the greatest value that a
  /// patch can have, 7.875. Whole numbers, so that sums are exact and the same on every machine.
  cv::Mat values;
  int constant_patches = 0;  ///< with σ = 0: a black or burnt-out part of the picture
};

/// Of a grey picture of any size: each pixel is the mean of the area that it covers, to 1/65536 of a level,
/// so that dark pictures keep their contrasts. Throws std::invalid_argument unless it is CV_8UC1 and not
/// empty.
Thumbnail makeThumbnail(const cv::Mat& grey);

/// D: mean absolute difference over all pixels, in units of σ. Runs in parallel, to the same bits.
PlaceMatrix thumbnailDifferences(const std::vector<Thumbnail>& queries, const std::vector<Thumbnail>& map);

}  // namespace sunlit::evaluate
