// The square about a key point, turned to its direction and brought to 21 x 21 grey levels.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace sunlit::evaluate::surf {

constexpr int kPatchSide = 21;  // samples, one scale apart; 20 gradients lie between them

using Patch = std::array<std::array<std::uint8_t, kPatchSide>, kPatchSide>;

// A grey image packed for bilinear sampling: each number holds the four pixels of one cell, so that a sample
// is one read.
class CellImage {
 public:
  explicit CellImage(const cv::Mat& grey);  // CV_8UC1, kept (not copied)
  const cv::Mat& grey() const { return grey_; }
  const std::uint32_t* cells() const { return cells_.data(); }
  // Of the cell between the pixels (x, y) and (x + 1, y + 1).
  std::uint32_t index(int y, int x) const {
    return static_cast<std::uint32_t>(guard_ + y * std::size_t(stride_) + x);
  }
  int stride() const { return stride_; }

 private:
  cv::Mat grey_;
  int stride_;
  std::size_t guard_;  // zeros before and after the image, so that a block of samples may end beyond it
  std::vector<std::uint32_t> cells_;
};

// Cuts patches; holds working memory, so each thread has its own.
class PatchCutter {
 public:
  explicit PatchCutter(const CellImage& image) : image_(image) {}

  // The window of whole pixels, 21 scales wide, about the key point. Its rows run along `angle_deg`; beyond
  // the border the image is continued by its outermost pixels. It is then averaged over areas.
  const Patch& turned(const cv::KeyPoint& point, float angle_deg);
  // The same at 270 degrees, without interpolation.
  const Patch& upright(const cv::KeyPoint& point);

  struct Span {
    int begin, end;  // samples of a row of the window; `end` is one past the last
  };

 private:
  void begin(int side);
  // Takes the row `row_`, number i of the window.
  void addRow(int i);
  void flush();
  const Patch& finish();
  // Of the window, px: its first sample, and the way from one to the next.
  struct Row {
    double x, y, dx, dy;
  };
  void sampleRow(const Row& row);
  void sampleInside(Span span, const Row& row);

  const CellImage& image_;
  int side_ = 0;
  int patch_row_ = 0;
  bool inside_ = false;                      // all of the window lies within the image
  std::vector<std::int32_t> row_;            // one row of the window, grey levels
  std::vector<std::uint32_t> column_sums_;   // rows so far of the current patch row, weighted in 1/21 px
  std::vector<std::uint64_t> sums_to_left_;  // of the columns left of each, and of all
  cv::Mat small_window_;                     // the whole window where it is smaller than the patch
  Patch patch_{};
};

}  // namespace sunlit::evaluate::surf
