#include "evaluate/features/surf_descriptor.h"

#include <cfloat>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "sunlit/quantity/vector_clones.h"

namespace sunlit::evaluate::surf {
namespace {

constexpr double kDescriptorSigma = 3.3;  // scales, of the Gaussian about the key point
constexpr int kCells = 4;                 // along one side
constexpr int kCellSide = 5;              // gradients along a cell's side
constexpr int kSide = kCells * kCellSide;

// Column sums over the five rows of one row of cells; `kinds` of them, each kSide long.
constexpr int kMaxKinds = 8;
using ColumnSums = std::array<std::array<float, kSide>, kMaxKinds>;

struct GradientRow {
  alignas(32) float dx[kSide];
  alignas(32) float dy[kSide];
};

SUNLIT_VECTOR_CLONES
void gradients(const std::uint8_t* upper, const std::uint8_t* lower, const float* weight, GradientRow* out) {
  for (int j = 0; j < kSide; ++j) {
    const int falling = lower[j + 1] - upper[j];  // along one diagonal
    const int rising = upper[j + 1] - lower[j];   // along the other
    out->dx[j] = static_cast<float>(falling + rising) * weight[j];
    out->dy[j] = static_cast<float>(falling - rising) * weight[j];
  }
}

SUNLIT_VECTOR_CLONES
void addBasic(const GradientRow& row, ColumnSums* sums) {
  for (int j = 0; j < kSide; ++j) {
    (*sums)[0][j] += row.dx[j];
    (*sums)[1][j] += row.dy[j];
    (*sums)[2][j] += std::abs(row.dx[j]);
    (*sums)[3][j] += std::abs(row.dy[j]);
  }
}

SUNLIT_VECTOR_CLONES
void addExtended(const GradientRow& row, ColumnSums* sums) {
  for (int j = 0; j < kSide; ++j) {
    const float dx = row.dx[j], dy = row.dy[j];
    const float dx_down = dy >= 0 ? dx : 0.0f;
    const float dy_right = dx >= 0 ? dy : 0.0f;
    (*sums)[0][j] += dx_down;
    (*sums)[1][j] += std::abs(dx_down);
    (*sums)[2][j] += dx - dx_down;
    (*sums)[3][j] += std::abs(dx - dx_down);
    (*sums)[4][j] += dy_right;
    (*sums)[5][j] += std::abs(dy_right);
    (*sums)[6][j] += dy - dy_right;
    (*sums)[7][j] += std::abs(dy - dy_right);
  }
}

void toUnitLength(float* out, int size) {
  double square = 0;
  for (int k = 0; k < size; ++k) square += static_cast<double>(out[k] * out[k]);
  const auto scale = static_cast<float>(1.0 / (std::sqrt(square) + FLT_EPSILON));
  for (int k = 0; k < size; ++k) out[k] *= scale;
}

}  // namespace

Descriptor::Descriptor(bool extended) : extended_(extended), weights_() {
  const cv::Mat gauss = cv::getGaussianKernel(kSide, kDescriptorSigma, CV_32F);
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) weights_[i][j] = gauss.at<float>(i) * gauss.at<float>(j);
  }
}

void Descriptor::of(const Patch& patch, float* out) const {
  const int kinds = size() / (kCells * kCells);
  GradientRow row;
  float* next = out;
  for (int cell_row = 0; cell_row < kCells; ++cell_row) {
    ColumnSums sums{};
    for (int i = cell_row * kCellSide; i < (cell_row + 1) * kCellSide; ++i) {
      gradients(patch[i].data(), patch[i + 1].data(), weights_[i].data(), &row);
      extended_ ? addExtended(row, &sums) : addBasic(row, &sums);
    }
    for (int cell = 0; cell < kCells; ++cell) {
      for (int kind = 0; kind < kinds; ++kind) {
        const float* s = sums[kind].data() + cell * kCellSide;
        *next++ = (s[0] + s[1]) + (s[2] + s[3]) + s[4];
      }
    }
  }
  toUnitLength(out, size());
}

}  // namespace sunlit::evaluate::surf
