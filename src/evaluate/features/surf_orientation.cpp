#include "evaluate/features/surf_orientation.h"

#include <opencv2/core/hal/hal.hpp>
#include <opencv2/imgproc.hpp>

#include "sunlit/quantity/vector_clones.h"

namespace sunlit::evaluate::surf {
namespace {

constexpr double kOrientationSigma = 2.5;  // scales, of the Gaussian about the key point
constexpr int kStepDeg = 5;                // between directions of the window
constexpr int kWindowDeg = 60;             // the window's width: open at both ends
constexpr int kDirections = 360 / kStepDeg;
constexpr int kHalf = kWindowDeg / 2 / kStepDeg;  // steps from the window's middle to its ends

// Sums of responses by angle, in two kinds of bins: a multiple of five degrees, and the degrees between two
// of those. A window holds whole bins only, and sums of bins stand for sums of samples. The first and last
// kHalf directions appear twice so that a window never wraps.
struct Bins {
  static constexpr int kSize = kDirections + 2 * kHalf;
  alignas(32) std::array<float, kSize> on{};
  alignas(32) std::array<float, kSize> between{};

  void add(int degree, float value) {
    const int direction = degree / kStepDeg % kDirections;
    (degree % kStepDeg == 0 ? on : between)[direction + kHalf] += value;
  }
  void wrap() {
    for (int k = 0; k < kHalf; ++k) {
      for (auto* bins : {&on, &between}) {
        (*bins)[k] = (*bins)[k + kDirections];
        (*bins)[k + kDirections + kHalf] = (*bins)[k + kHalf];
      }
    }
  }
};

// out[d] = sum over the open window (5 d - 30, 5 d + 30) degrees.
SUNLIT_VECTOR_CLONES
void windowSums(const float* on, const float* between, float* __restrict out) {
  for (int d = 0; d < kDirections; ++d) out[d] = between[d];
  for (int k = 1; k < 2 * kHalf; ++k) {
    for (int d = 0; d < kDirections; ++d) out[d] += on[d + k] + between[d + k];
  }
}

}  // namespace

Orientation::Orientation() : samples_() {
  const cv::Mat gauss = cv::getGaussianKernel(2 * kRadius + 1, kOrientationSigma, CV_32F);
  int n = 0;
  for (int dx = -kRadius; dx <= kRadius; ++dx) {
    for (int dy = -kRadius; dy <= kRadius; ++dy) {
      if (dx * dx + dy * dy > kRadius * kRadius) continue;
      samples_.at(n++) = {static_cast<float>(dx), static_cast<float>(dy),
                          gauss.at<float>(dx + kRadius) * gauss.at<float>(dy + kRadius)};
    }
  }
  CV_Assert(n == kSamples);
}

int Orientation::waveletSize(float size) {
  return 2 * cvRound(2 * scaleOfSize(size));
}

Orientation::Responses Orientation::responses(const cv::KeyPoint& point, const cv::Mat& integral) const {
  const float scale = scaleOfSize(point.size);
  const int side = waveletSize(point.size);
  const int half = side / 2;
  const float offset = static_cast<float>(side - 1) / 2;
  const float inverse_area = 1.0f / (static_cast<float>(half) * static_cast<float>(side));
  const auto stride = static_cast<std::ptrdiff_t>(integral.step1());
  const int x_end = integral.cols - side;
  const int y_end = integral.rows - side;
  Responses r;
  for (const Sample& sample : samples_) {
    const int x = cvRound(point.pt.x + sample.dx * scale - offset);
    const int y = cvRound(point.pt.y + sample.dy * scale - offset);
    if (x < 0 || x >= x_end || y < 0 || y >= y_end) continue;
    const int* top = integral.ptr<int>(y) + x;
    const int* middle = top + half * stride;
    const int* bottom = middle + half * stride;
    const auto sum = [&](const int* row, int dx) { return static_cast<std::uint32_t>(row[dx]); };
    const std::uint32_t all = sum(bottom, side) - sum(bottom, 0) - sum(top, side) + sum(top, 0);
    const std::uint32_t left = sum(bottom, half) - sum(bottom, 0) - sum(top, half) + sum(top, 0);
    const std::uint32_t upper = sum(middle, side) - sum(middle, 0) - sum(top, side) + sum(top, 0);
    // Right less left, and upper less lower: the angle turns anticlockwise on the screen.
    const auto dx = static_cast<float>(static_cast<std::int32_t>(all - 2 * left));
    const auto dy = static_cast<float>(static_cast<std::int32_t>(2 * upper - all));
    r.x[r.count] = dx * inverse_area * sample.weight;
    r.y[r.count] = dy * inverse_area * sample.weight;
    ++r.count;
  }
  return r;
}

std::optional<float> Orientation::of(const cv::KeyPoint& point, const cv::Mat& integral) const {
  Responses r = responses(point, integral);
  if (r.count == 0) return std::nullopt;
  cv::hal::fastAtan32f(r.y.data(), r.x.data(), r.angle_deg.data(), r.count, true);

  Bins bins_x, bins_y;
  for (int k = 0; k < r.count; ++k) {
    const int degree = cvRound(r.angle_deg[k]);
    bins_x.add(degree, r.x[k]);
    bins_y.add(degree, r.y[k]);
  }
  bins_x.wrap();
  bins_y.wrap();
  std::array<float, kDirections> x{}, y{};
  windowSums(bins_x.on.data(), bins_x.between.data(), x.data());
  windowSums(bins_y.on.data(), bins_y.between.data(), y.data());

  float best_x = 0, best_y = 0, best = 0;
  for (int d = 0; d < kDirections; ++d) {
    const float strength = x[d] * x[d] + y[d] * y[d];
    if (strength <= best) continue;
    best = strength;
    best_x = x[d];
    best_y = y[d];
  }
  return cv::fastAtan2(-best_y, best_x);
}

}  // namespace sunlit::evaluate::surf
