/// Pictures row by row.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

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

}  // namespace sunlit::image
