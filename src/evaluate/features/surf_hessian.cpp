#include "evaluate/features/surf_hessian.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "sunlit/quantity/vector_clones.h"

namespace sunlit::evaluate::surf {
namespace {

constexpr int kFirstFilter = 9;         // px, the paper's smallest filter, equal to a Gaussian of 1.2 px
constexpr int kFilterIncrement = 6;     // px a layer: the filter stays symmetric about a pixel
constexpr float kMixedBalance = 0.81f;  // (0.9)^2: boxes for Gaussians, equation (3) of the paper

using Sums = const std::uint32_t*;

// The two rows and four columns (or the transpose) that bound three lobes side by side, weighted 1, -2, 1.
// That is the box over all three less three times the middle one, which whole numbers hold exactly.
struct SecondDerivative {
  std::array<Sums, 4> low;
  std::array<Sums, 4> high;
};

// The sixteen corners of four lobes, weighted 1, -1, -1, 1.
struct MixedDerivative {
  std::array<std::array<Sums, 4>, 4> corner;  // [row][column]
};

SUNLIT_VECTOR_CLONES
void secondDerivativeRow(const SecondDerivative& at, float weight, int count, float* __restrict out) {
  Sums a0 = at.low[0], a1 = at.low[1], a2 = at.low[2], a3 = at.low[3];
  Sums b0 = at.high[0], b1 = at.high[1], b2 = at.high[2], b3 = at.high[3];
  for (int j = 0; j < count; ++j) {
    const std::uint32_t whole = (b3[j] - a3[j]) - (b0[j] - a0[j]);
    const std::uint32_t middle = (b2[j] - a2[j]) - (b1[j] - a1[j]);
    out[j] = static_cast<float>(static_cast<std::int32_t>(whole - 3 * middle)) * weight;
  }
}

SUNLIT_VECTOR_CLONES
void mixedLobesRow(const std::array<Sums, 4>& top, const std::array<Sums, 4>& bottom, int count,
                   std::uint32_t* __restrict out) {
  Sums t0 = top[0], t1 = top[1], t2 = top[2], t3 = top[3];
  Sums b0 = bottom[0], b1 = bottom[1], b2 = bottom[2], b3 = bottom[3];
  for (int j = 0; j < count; ++j) {
    const std::uint32_t left = (b1[j] - t1[j]) - (b0[j] - t0[j]);
    const std::uint32_t right = (b3[j] - t3[j]) - (b2[j] - t2[j]);
    out[j] = left - right;
  }
}

struct RowBuffers {
  explicit RowBuffers(int count) : dxx(count), dyy(count), upper(count), lower(count) {}
  std::vector<float> dxx, dyy;
  std::vector<std::uint32_t> upper, lower;
};

SUNLIT_VECTOR_CLONES
void determinantRow(const RowBuffers& row, float mixed_weight, int count, float* __restrict out) {
  const float* dxx = row.dxx.data();
  const float* dyy = row.dyy.data();
  Sums upper = row.upper.data();
  Sums lower = row.lower.data();
  for (int j = 0; j < count; ++j) {
    const float dxy = static_cast<float>(static_cast<std::int32_t>(upper[j] - lower[j])) * mixed_weight;
    out[j] = dxx[j] * dyy[j] - kMixedBalance * dxy * dxy;
  }
}

SecondDerivative alongX(const IntegralPlanes& planes, const BoxFilters& f, int y) {
  SecondDerivative d{};
  for (int k = 0; k < 4; ++k) {
    d.low[k] = planes.at(y + f.at[2], f.at[3 * k]);
    d.high[k] = planes.at(y + f.at[7], f.at[3 * k]);
  }
  return d;
}

SecondDerivative alongY(const IntegralPlanes& planes, const BoxFilters& f, int y) {
  SecondDerivative d{};
  for (int k = 0; k < 4; ++k) {
    d.low[k] = planes.at(y + f.at[3 * k], f.at[2]);
    d.high[k] = planes.at(y + f.at[3 * k], f.at[7]);
  }
  return d;
}

MixedDerivative mixed(const IntegralPlanes& planes, const BoxFilters& f, int y) {
  constexpr std::array<int, 4> kNinths = {1, 4, 5, 8};
  MixedDerivative d{};
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) d.corner[r][c] = planes.at(y + f.at[kNinths[r]], f.at[kNinths[c]]);
  }
  return d;
}

/// What a layer is made by.
struct LayerSource {
  const IntegralPlanes& planes;
  const BoxFilters& filters;
};

void layerRow(const LayerSource& source, int y, RowBuffers& buffers, float* out) {
  const IntegralPlanes& planes = source.planes;
  const BoxFilters& f = source.filters;
  const int count = static_cast<int>(buffers.dxx.size());
  secondDerivativeRow(alongX(planes, f, y), f.second_weight, count, buffers.dxx.data());
  secondDerivativeRow(alongY(planes, f, y), f.second_weight, count, buffers.dyy.data());
  const MixedDerivative m = mixed(planes, f, y);
  mixedLobesRow(m.corner[0], m.corner[1], count, buffers.upper.data());
  mixedLobesRow(m.corner[2], m.corner[3], count, buffers.lower.data());
  determinantRow(buffers, f.mixed_weight, count, out);
}

}  // namespace

IntegralPlanes::IntegralPlanes(const cv::Mat& integral, int step)
    : rows_(integral.rows), cols_(integral.cols), step_(step), width_((integral.cols + step - 1) / step) {
  CV_Assert(integral.type() == CV_32S);
  data_.resize(static_cast<std::size_t>(rows_) * step_ * width_);
  for (int y = 0; y < rows_; ++y) {
    const int* from = integral.ptr<int>(y);
    for (int plane = 0; plane < step_; ++plane) {
      std::uint32_t* to = data_.data() + (static_cast<std::size_t>(y) * step_ + plane) * width_;
      for (int x = plane; x < cols_; x += step_) *to++ = static_cast<std::uint32_t>(from[x]);
    }
  }
}

BoxFilters::BoxFilters(int filter_size) : size(filter_size), at() {
  const float ninth = static_cast<float>(size) / 9;
  for (int k = 0; k < 10; ++k) at[k] = cvRound(ninth * k);
  second_weight = 1.0f / (static_cast<float>(at[3]) * static_cast<float>(at[7] - at[2]));
  mixed_weight = 1.0f / (static_cast<float>(at[4] - at[1]) * static_cast<float>(at[4] - at[1]));
}

int filterSize(int octave, int layer) {
  return (kFirstFilter + kFilterIncrement * layer) << octave;
}

HessianLayer hessianLayer(const IntegralPlanes& planes, int size) {
  HessianLayer layer;
  layer.size = size;
  layer.step = planes.step();
  layer.rows = planes.imageRows() / layer.step;
  layer.cols = planes.imageCols() / layer.step;
  layer.margin = (size / 2) / layer.step;
  layer.determinant.resize(static_cast<std::size_t>(layer.rows) * layer.cols);
  if (size > planes.imageRows() || size > planes.imageCols()) return layer;

  const BoxFilters filters(size);
  const int rows = 1 + (planes.imageRows() - size) / layer.step;
  const int cols = 1 + (planes.imageCols() - size) / layer.step;
  tbb::parallel_for(tbb::blocked_range<int>(0, rows, 16), [&](const tbb::blocked_range<int>& range) {
    RowBuffers buffers(cols);
    for (int i = range.begin(); i < range.end(); ++i) {
      float* out =
          layer.determinant.data() + static_cast<std::size_t>(i + layer.margin) * layer.cols + layer.margin;
      layerRow({planes, filters}, i * layer.step, buffers, out);
    }
  });
  return layer;
}

float laplacian(const cv::Mat& integral, const BoxFilters& f, int y, int x) {
  const auto box = [&](int y0, int x0, int y1, int x1) {
    const auto sum = [&](int r, int c) { return static_cast<std::uint32_t>(integral.at<int>(y + r, x + c)); };
    return sum(y1, x1) - sum(y0, x1) - sum(y1, x0) + sum(y0, x0);
  };
  const auto second = [&](std::uint32_t whole, std::uint32_t middle) {
    return static_cast<float>(static_cast<std::int32_t>(whole - 3 * middle)) * f.second_weight;
  };
  const float dxx = second(box(f.at[2], 0, f.at[7], f.at[9]), box(f.at[2], f.at[3], f.at[7], f.at[6]));
  const float dyy = second(box(0, f.at[2], f.at[9], f.at[7]), box(f.at[3], f.at[2], f.at[6], f.at[7]));
  return dxx + dyy;
}

}  // namespace sunlit::evaluate::surf
