#include "evaluate/features/surf_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "evaluate/features/surf_orientation.h"
#include "sunlit/quantity/vector_clones.h"

namespace sunlit::evaluate::surf {
namespace {

// Adding and taking away 1.5 * 2^23 leaves the nearest whole number (ties to even) of a small float, in plain
// additions that every vector unit has.
constexpr float kRounder = 12582912.0f;

// Samples are taken in blocks of a vector's length; a last, partly used block may look this far beyond the
// window.
constexpr int kBlock = 8;

// Samples this far from the image's border, in px, stay within it whatever the rounding of a walk in single
// precision.
constexpr double kInside = 1e-2;

struct Walk {
  std::uint32_t start;  // a cell: unsigned indices spare vector units the sign
  float x, y;           // of the first sample, from the corner of that cell
  float dx, dy;         // px a sample, at most 1
};

SUNLIT_VECTOR_CLONES
void bilinearBlocks(const std::uint32_t* __restrict cells, int stride, const Walk& walk, int blocks,
                    std::int32_t* __restrict out) {
  const std::uint32_t start = walk.start;
  const float x0 = walk.x, y0 = walk.y, dx = walk.dx, dy = walk.dy;
  for (int j = 0; j < blocks * kBlock; ++j) {
    const float x = x0 + static_cast<float>(j) * dx;
    const float y = y0 + static_cast<float>(j) * dy;
    const auto ix = static_cast<std::int32_t>(x);
    const auto iy = static_cast<std::int32_t>(y);
    const float a = x - static_cast<float>(ix);
    const float b = y - static_cast<float>(iy);
    const std::uint32_t cell = cells[start + static_cast<std::uint32_t>(iy * stride + ix)];
    const auto p00 = static_cast<float>(static_cast<std::int32_t>(cell & 255u));
    const auto p01 = static_cast<float>(static_cast<std::int32_t>((cell >> 8) & 255u));
    const auto p10 = static_cast<float>(static_cast<std::int32_t>((cell >> 16) & 255u));
    const auto p11 = static_cast<float>(static_cast<std::int32_t>(cell >> 24));
    const float top = p00 + a * (p01 - p00);
    const float bottom = p10 + a * (p11 - p10);
    const float value = top + b * (bottom - top);
    out[j] = static_cast<std::int32_t>((value + kRounder) - kRounder);
  }
}

SUNLIT_VECTOR_CLONES
void accumulate(const std::int32_t* __restrict row, std::uint32_t weight, int count,
                std::uint32_t* __restrict sums) {
  for (int j = 0; j < count; ++j) sums[j] += weight * static_cast<std::uint32_t>(row[j]);
}

std::uint8_t clampedPixel(const cv::Mat& grey, int y, int x) {
  return grey.at<std::uint8_t>(std::clamp(y, 0, grey.rows - 1), std::clamp(x, 0, grey.cols - 1));
}

// One sample: between four pixels where there are four, else the
// nearest pixel of the image.
std::int32_t sampleAnywhere(const cv::Mat& grey, double x, double y) {
  const int ix = cvFloor(x), iy = cvFloor(y);
  if (ix < 0 || iy < 0 || ix >= grey.cols - 1 || iy >= grey.rows - 1)
    return clampedPixel(grey, cvRound(y), cvRound(x));
  const auto* p = grey.ptr<std::uint8_t>(iy) + ix;
  const auto* q = grey.ptr<std::uint8_t>(iy + 1) + ix;
  const double a = x - ix, b = y - iy;
  return cvRound((p[0] * (1 - a) + p[1] * a) * (1 - b) + (q[0] * (1 - a) + q[1] * a) * b);
}

// The samples start + k step of one coordinate.
struct Steps {
  double start, step;
};

// Of those in `span`, the ones from `low` to `high`.
PatchCutter::Span within(PatchCutter::Span span, const Steps& steps, double low, double high) {
  const auto [start, step] = steps;
  if (std::abs(step) < 1e-9) return start >= low && start <= high ? span : PatchCutter::Span{0, 0};
  const double t0 = (low - start) / step, t1 = (high - start) / step;
  const double first = std::ceil(std::min(t0, t1)), last = std::floor(std::max(t0, t1));
  if (!(first < span.end) || !(last >= span.begin)) return {0, 0};
  return {std::max(span.begin, static_cast<int>(first)),
          static_cast<int>(std::min(span.end - 1.0, last)) + 1};
}

int windowSide(const cv::KeyPoint& point) {
  return static_cast<int>(static_cast<float>(kPatchSide) * scaleOfSize(point.size));
}

}  // namespace

CellImage::CellImage(const cv::Mat& grey)
    : grey_(grey), stride_(grey.cols), guard_(static_cast<std::size_t>(kBlock) * (grey.cols + 1)) {
  CV_Assert(grey.type() == CV_8UC1);
  CV_Assert(static_cast<double>(grey.rows + 2 * kBlock + 1) * (stride_ + 1) <
            std::numeric_limits<std::int32_t>::max());
  cells_.resize(static_cast<std::size_t>(grey.rows) * stride_ + 2 * guard_);
  for (int y = 0; y + 1 < grey.rows; ++y) {
    const auto* top = grey.ptr<std::uint8_t>(y);
    const auto* bottom = grey.ptr<std::uint8_t>(y + 1);
    std::uint32_t* out = cells_.data() + guard_ + static_cast<std::size_t>(y) * stride_;
    for (int x = 0; x + 1 < grey.cols; ++x) {
      out[x] = top[x] | static_cast<std::uint32_t>(top[x + 1]) << 8 |
               static_cast<std::uint32_t>(bottom[x]) << 16 | static_cast<std::uint32_t>(bottom[x + 1]) << 24;
    }
  }
}

void PatchCutter::begin(int side) {
  CV_CheckGT(side, 0, "a key point is too small to describe");
  side_ = side;
  patch_row_ = 0;
  row_.resize(static_cast<std::size_t>(side) + kBlock);
  column_sums_.assign(static_cast<std::size_t>(side) + 1, 0);
  sums_to_left_.assign(static_cast<std::size_t>(side) + 1, 0);
  if (side < kPatchSide) small_window_.create(side, side, CV_8U);
}

// Lengths are counted in 1/21 px, so that pixels (21 of them long) and patch cells (side_ long) both have
// whole ends.
void PatchCutter::addRow(int i) {
  if (side_ < kPatchSide) {
    std::copy(row_.begin(), row_.begin() + side_, small_window_.ptr<std::uint8_t>(i));
    return;
  }
  const int end_of_row = kPatchSide * (i + 1);
  const int end_of_cell = side_ * (patch_row_ + 1);
  const int rest = std::max(end_of_row - end_of_cell, 0);
  accumulate(row_.data(), static_cast<std::uint32_t>(kPatchSide - rest), side_, column_sums_.data());
  if (end_of_row < end_of_cell) return;
  flush();
  std::fill(column_sums_.begin(), column_sums_.end(), 0);
  if (rest > 0) accumulate(row_.data(), static_cast<std::uint32_t>(rest), side_, column_sums_.data());
}

// Finishes a row of the patch: the same averaging along x, by sums from the left end up to the ends of cells.
void PatchCutter::flush() {
  for (int j = 0; j < side_; ++j) sums_to_left_[j + 1] = sums_to_left_[j] + column_sums_[j];
  const auto sum_up_to = [&](int end) {
    const int whole = end / kPatchSide;
    const int part = end % kPatchSide;
    return static_cast<std::uint64_t>(kPatchSide) * sums_to_left_[whole] +
           static_cast<std::uint64_t>(part) * column_sums_[whole];
  };
  const double area = static_cast<double>(side_) * side_;
  std::uint64_t left = 0;
  for (int cell = 0; cell < kPatchSide; ++cell) {
    const std::uint64_t right = sum_up_to(side_ * (cell + 1));
    // cv::resize rounds halves up where it halves an image, and to even elsewhere.
    const double mean = static_cast<double>(right - left) / area;
    const int level = side_ == 2 * kPatchSide ? static_cast<int>(mean + 0.5) : cvRound(mean);
    patch_[patch_row_][cell] = static_cast<std::uint8_t>(level);
    left = right;
  }
  ++patch_row_;
}

const Patch& PatchCutter::finish() {
  if (side_ < kPatchSide) {
    cv::Mat out(kPatchSide, kPatchSide, CV_8U, patch_[0].data());
    cv::resize(small_window_, out, out.size(), 0, 0, cv::INTER_AREA);
  }
  return patch_;
}

void PatchCutter::sampleRow(const Row& row) {
  if (inside_) {
    sampleInside({0, side_}, row);
    return;
  }
  const auto [x, y, dx, dy] = row;
  const cv::Mat& grey = image_.grey();
  Span span = within({0, side_}, {x, dx}, kInside, grey.cols - 1 - kInside);
  span = within(span, {y, dy}, kInside, grey.rows - 1 - kInside);
  if (span.begin < span.end) sampleInside(span, row);
  for (int j = 0; j < span.begin; ++j) row_[j] = sampleAnywhere(grey, x + dx * j, y + dy * j);
  for (int j = span.end; j < side_; ++j) row_[j] = sampleAnywhere(grey, x + dx * j, y + dy * j);
}

void PatchCutter::sampleInside(Span span, const Row& row) {
  const auto [x, y, dx, dy] = row;
  const double first_x = x + dx * span.begin, last_x = x + dx * (span.end - 1);
  const double first_y = y + dy * span.begin, last_y = y + dy * (span.end - 1);
  const int cell_x = static_cast<int>(std::min(first_x, last_x));  // not negative
  const int cell_y = static_cast<int>(std::min(first_y, last_y));
  const Walk walk{image_.index(cell_y, cell_x), static_cast<float>(first_x - cell_x),
                  static_cast<float>(first_y - cell_y), static_cast<float>(dx), static_cast<float>(dy)};
  const int blocks = (span.end - span.begin + kBlock - 1) / kBlock;
  bilinearBlocks(image_.cells(), image_.stride(), walk, blocks, row_.data() + span.begin);
}

const Patch& PatchCutter::turned(const cv::KeyPoint& point, float angle_deg) {
  begin(windowSide(point));
  const float angle = angle_deg * static_cast<float>(CV_PI / 180);
  const float cosine = std::cos(angle);
  const float sine = std::sin(angle);
  const float offset = static_cast<float>(side_ - 1) / 2;
  float x = point.pt.x - offset * cosine + offset * sine;
  float y = point.pt.y - offset * sine - offset * cosine;
  const float reach = (std::abs(offset) + 1) * (std::abs(cosine) + std::abs(sine));
  inside_ = point.pt.x > reach && point.pt.x + reach < static_cast<float>(image_.grey().cols - 1) &&
            point.pt.y > reach && point.pt.y + reach < static_cast<float>(image_.grey().rows - 1);
  for (int i = 0; i < side_; ++i, x -= sine, y += cosine) {
    sampleRow({x, y, cosine, sine});
    addRow(i);
  }
  return finish();
}

const Patch& PatchCutter::upright(const cv::KeyPoint& point) {
  begin(windowSide(point));
  const float offset = static_cast<float>(side_ - 1) / 2;
  const int x = cvRound(point.pt.x - offset);
  const int y = cvRound(point.pt.y + offset);
  for (int i = 0; i < side_; ++i) {
    for (int j = 0; j < side_; ++j) row_[j] = clampedPixel(image_.grey(), y - j, x + i);
    addRow(i);
  }
  return finish();
}

}  // namespace sunlit::evaluate::surf
