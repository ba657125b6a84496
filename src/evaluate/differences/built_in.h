/// The differences of pixels that are built in, one file each.
#pragma once

#include <memory>

#include "sunlit/evaluate/differences/difference.h"

namespace sunlit::evaluate {

enum class Channels { kRgb, kGrey };

inline const cv::Mat& imageOf(const View& view, Channels channels) {
  return channels == Channels::kRgb ? view.picture.rgb : view.picture.grey;
}

/// (4) of the paper: share of pixels that differ, of rgb in any channel.
std::unique_ptr<Difference> makeBoolean(Channels channels);
/// (6): mean of Σ_c (a_c − b_c)² / (3 · 255²); of grey, (5): mean of (a − b)² / 255². Both in [0, 1].
std::unique_ptr<Difference> makeEuclidean(Channels channels);

}  // namespace sunlit::evaluate
