/// Pictures row by row.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sunlit/image/images.h"

namespace sunlit::image {

/// Calls `of_row` with the number of each row, in parallel.
template <typename OfRow>
void eachRow(int height, const OfRow& of_row) {
  tbb::parallel_for(tbb::blocked_range<int>(0, height, 8), [&](const tbb::blocked_range<int>& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y) of_row(y);
  });
}

/// Of a row or column beyond the edge the one as far within it. What is blurred so keeps its light: what each
/// sends to others it gets from them.
inline int mirrored(int place, int count) {
  const int turn = place % (2 * count);
  const int within = turn < 0 ? turn + 2 * count : turn;
  return within < count ? within : 2 * count - 1 - within;
}

/// Row `y` of `picture` with `margin` pixels more at either end, mirrored().
inline void copyWide(const LinearImage& picture, int y, int margin, std::vector<float>* wide) {
  wide->resize(3 * static_cast<std::size_t>(picture.width + 2 * margin));
  float* out = wide->data();
  const auto beyond = [&](int begin, int end) {
    for (int x = begin; x < end; ++x) out = std::copy_n(picture.at(mirrored(x, picture.width), y), 3, out);
  };
  beyond(-margin, 0);
  out = std::copy_n(picture.at(0, y), 3 * picture.width, out);
  beyond(picture.width, picture.width + margin);
}

}  // namespace sunlit::image
