#include "evaluate/features/surf_maxima.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <tuple>

#include "sunlit/quantity/vector_clones.h"

namespace sunlit::evaluate::surf {
namespace {

constexpr int kBandRows = 16;

// Marks samples above the threshold and all eight neighbours of their layer. Rows point at the first sample
// to judge.
SUNLIT_VECTOR_CLONES
void markRow(const float* above, const float* row, const float* below, float threshold, int count,
             std::uint8_t* __restrict mark) {
  for (int j = 0; j < count; ++j) {
    const float v = row[j];
    const int higher = static_cast<int>(v > threshold) & static_cast<int>(v > row[j - 1]) &
                       static_cast<int>(v > row[j + 1]) & static_cast<int>(v > above[j - 1]) &
                       static_cast<int>(v > above[j]) & static_cast<int>(v > above[j + 1]) &
                       static_cast<int>(v > below[j - 1]) & static_cast<int>(v > below[j]) &
                       static_cast<int>(v > below[j + 1]);
    mark[j] = static_cast<std::uint8_t>(higher);
  }
}

bool exceedsAll(float v, const HessianLayer& layer, int i, int j) {
  for (int di = -1; di <= 1; ++di) {
    const float* row = layer.row(i + di) + j;
    if (v <= row[-1] || v <= row[0] || v <= row[1]) return false;
  }
  return true;
}

// Offset of the vertex of the quadratic through the 3 x 3 x 3 samples, in samples (x, y, layer), by one
// Newton step from central differences. Nothing where it is further than one sample off, or where there is
// none.
std::optional<cv::Vec3f> vertex(const LayerTriple& layers, int i, int j) {
  const auto at = [&](int dx, int dy, int ds) {
    const HessianLayer& layer = ds < 0 ? *layers.below : ds > 0 ? *layers.above : *layers.middle;
    return layer.row(i + dy)[j + dx];
  };
  const float centre = at(0, 0, 0);
  const auto slope = [&](int dx, int dy, int ds) { return (at(dx, dy, ds) - at(-dx, -dy, -ds)) / 2; };
  const auto bend = [&](int dx, int dy, int ds) { return at(dx, dy, ds) - 2 * centre + at(-dx, -dy, -ds); };
  const float xy = (at(1, 1, 0) - at(-1, 1, 0) - at(1, -1, 0) + at(-1, -1, 0)) / 4;
  const float xs = (at(1, 0, 1) - at(-1, 0, 1) - at(1, 0, -1) + at(-1, 0, -1)) / 4;
  const float ys = (at(0, 1, 1) - at(0, -1, 1) - at(0, 1, -1) + at(0, -1, -1)) / 4;
  const cv::Matx33f second(bend(1, 0, 0), xy, xs, xy, bend(0, 1, 0), ys, xs, ys, bend(0, 0, 1));
  const cv::Vec3f first(slope(1, 0, 0), slope(0, 1, 0), slope(0, 0, 1));
  const cv::Vec3f offset = second.solve(-first, cv::DECOMP_LU);
  if (offset == cv::Vec3f(0, 0, 0)) return std::nullopt;  // also what a singular matrix gives
  for (int k = 0; k < 3; ++k) {
    if (!(std::abs(offset[k]) <= 1)) return std::nullopt;
  }
  return offset;
}

bool masked(const cv::Mat& mask_integral, int y, int x, int size) {
  if (mask_integral.empty()) return false;
  const int allowed = mask_integral.at<int>(y + size, x + size) - mask_integral.at<int>(y + size, x) -
                      mask_integral.at<int>(y, x + size) + mask_integral.at<int>(y, x);
  return 2 * static_cast<std::int64_t>(allowed) < static_cast<std::int64_t>(size) * size;
}

// The key point of sample (i, j) of the middle layer if that is a maximum in scale too.
std::optional<cv::KeyPoint> keypointAt(const LayerTriple& layers, const MaximaInput& input, int i, int j) {
  const HessianLayer& layer = *layers.middle;
  const float response = layer.row(i)[j];
  if (!exceedsAll(response, *layers.below, i, j) || !exceedsAll(response, *layers.above, i, j)) return {};
  const int y = layer.step * (i - layer.margin);  // of the filter's top left corner
  const int x = layer.step * (j - layer.margin);
  if (masked(input.mask_integral, y, x, layer.size)) return {};
  const auto offset = vertex(layers, i, j);
  if (!offset) return {};

  const float half = static_cast<float>(layer.size - 1) * 0.5f;
  const auto step = static_cast<float>(layer.step);
  const auto size_step = static_cast<float>(layer.size - layers.below->size);
  const float trace = laplacian(input.integral, BoxFilters(layer.size), y, x);
  cv::KeyPoint point;
  point.pt.x = static_cast<float>(x) + half + (*offset)[0] * step;
  point.pt.y = static_cast<float>(y) + half + (*offset)[1] * step;
  point.size = static_cast<float>(cvRound(static_cast<float>(layer.size) + (*offset)[2] * size_step));
  point.response = response;
  point.octave = layers.octave;
  point.class_id = static_cast<int>(trace > 0) - static_cast<int>(trace < 0);
  return point;
}

struct Band {
  int first_row;
  int last_row;  // one past
  int margin;
};

std::vector<cv::KeyPoint> findInBand(const LayerTriple& layers, const MaximaInput& input, const Band& band) {
  std::vector<cv::KeyPoint> found;
  const HessianLayer& layer = *layers.middle;
  const int count = layer.cols - 2 * band.margin;
  std::vector<std::uint8_t> marks(static_cast<std::size_t>(count) + sizeof(std::uint64_t), 0);
  for (int i = band.first_row; i < band.last_row; ++i) {
    const float* row = layer.row(i) + band.margin;
    markRow(row - layer.cols, row, row + layer.cols, input.threshold, count, marks.data());
    for (int j = 0; j < count; ++j) {
      std::uint64_t eight;  // marks are rare: skip eight empty ones at once
      std::memcpy(&eight, marks.data() + j, sizeof eight);
      if (eight == 0) {
        j += 7;
        continue;
      }
      if (marks[j] == 0) continue;
      if (const auto point = keypointAt(layers, input, i, j + band.margin)) found.push_back(*point);
    }
  }
  return found;
}

}  // namespace

std::vector<cv::KeyPoint> findMaxima(const LayerTriple& layers, const MaximaInput& input) {
  // One sample inside of what the largest filter of the three can reach.
  const int margin = layers.above->margin + 1;
  const int rows = layers.middle->rows - 2 * margin;
  if (rows <= 0 || layers.middle->cols - 2 * margin <= 0) return {};

  const int bands = (rows + kBandRows - 1) / kBandRows;
  std::vector<std::vector<cv::KeyPoint>> found(static_cast<std::size_t>(bands));
  tbb::parallel_for(0, bands, [&](int b) {
    const int first = margin + b * kBandRows;
    found[b] = findInBand(layers, input, {first, std::min(first + kBandRows, margin + rows), margin});
  });
  std::vector<cv::KeyPoint> all;
  for (const auto& band : found) all.insert(all.end(), band.begin(), band.end());
  return all;
}

void sortByResponse(std::vector<cv::KeyPoint>& keypoints) {
  // Of equals the larger, then the one of the higher octave, then the lower in the image, then the one
  // further left.
  const auto key = [](const cv::KeyPoint& k) {
    return std::make_tuple(-k.response, -k.size, -k.octave, -k.pt.y, k.pt.x);
  };
  std::sort(keypoints.begin(), keypoints.end(),
            [&](const cv::KeyPoint& a, const cv::KeyPoint& b) { return key(a) < key(b); });
}

}  // namespace sunlit::evaluate::surf
