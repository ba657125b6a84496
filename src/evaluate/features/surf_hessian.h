// The determinant of the Hessian over position and scale, by box filters on the integral image (Bay et al.
// 2008, 3.2).
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace sunlit::evaluate::surf {

// The integral image with its columns dealt to `step` planes (column c lies in plane c % step), so that a
// filter which is sampled every `step` pixels still reads neighbouring numbers. Sums are taken modulo 2^32:
// differences over a box are right as long as the box itself does not overflow.
class IntegralPlanes {
 public:
  // `integral`: CV_32S, one row and column more than the picture.
  IntegralPlanes(const cv::Mat& integral, int step);
  const std::uint32_t* at(int y, int x) const {
    return data_.data() + (static_cast<std::size_t>(y) * step_ + x % step_) * width_ + x / step_;
  }
  int step() const { return step_; }
  int imageRows() const { return rows_ - 1; }
  int imageCols() const { return cols_ - 1; }

 private:
  int rows_, cols_, step_, width_;
  std::vector<std::uint32_t> data_;
};

// The box filters of one size, in px from the top left corner of the filter's square.
struct BoxFilters {
  explicit BoxFilters(int filter_size);
  int size;
  std::array<int, 10> at;  // where the ninths of the side fall, rounded to whole pixels
  float second_weight;     // 1 / area of one lobe of Dxx (and Dyy)
  float mixed_weight;      // 1 / area of one lobe of Dxy
};

// Determinants of one filter size: `determinant` holds rows x cols samples, `step` px apart. Samples nearer
// than `margin` to the border are 0: there the filter does not fit.
struct HessianLayer {
  int size = 0;
  int step = 1;
  int rows = 0;
  int cols = 0;
  int margin = 0;
  std::vector<float> determinant;
  const float* row(int i) const { return determinant.data() + static_cast<std::size_t>(i) * cols; }
};

// Filter size of a layer (0 to octave_layers + 1) of an octave (from 0): 9, 15, 21 ... px, doubled per
// octave.
int filterSize(int octave, int layer);

HessianLayer hessianLayer(const IntegralPlanes& planes, int size);

// Dxx + Dyy of the filter whose square has its top left corner at (x, y).
float laplacian(const cv::Mat& integral, const BoxFilters& filters, int y, int x);

}  // namespace sunlit::evaluate::surf
