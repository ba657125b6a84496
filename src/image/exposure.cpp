#include "sunlit/image/exposure.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "display_curve.h"

namespace sunlit::image {
namespace {

void requireWithin(const char* key, double value, double low, double high) {
  if (!(value >= low && value <= high)) {
    std::ostringstream message;
    message << key << ": " << value << " is outside " << low << " … " << high;
    throw std::invalid_argument(message.str());
  }
}

// The metered mean becomes 18 % of saturation, which is level 118 of 255: standard output sensitivity, ISO
// 12232:2019.
constexpr double kMeteredPart = 0.18;

/// Luminances counted by the leading bits of their float: 256 steps an octave, without a logarithm a pixel.
/// Counts are integers, so the order of pixels does not matter.
class LuminanceHistogram {
 public:
  LuminanceHistogram() : counts_(kSteps, 0) {}

  void add(float luminance, std::int64_t weight) { counts_[step(luminance)] += weight; }

  /// Mean of log2(luminance) of the weight between the two parts of the whole. At least one pixel was added.
  double trimmedLogMean(double low_part, double high_part) const {
    const auto total = static_cast<double>(std::accumulate(counts_.begin(), counts_.end(), std::int64_t{0}));
    const double low = low_part * total;
    const double high = high_part * total;
    double before = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < kSteps; ++i) {
      const double after = before + static_cast<double>(counts_[i]);
      const double inside = std::min(after, high) - std::max(before, low);
      if (inside > 0.0) {
        sum += inside * std::log2(middle(i));
      }
      before = after;
    }
    return sum / (high - low);
  }

 private:
  static constexpr int kShift = 15;                 // leaves 8 bits of the mantissa
  static constexpr float kDarkest = 0x1p-24F;       // cd/m²; far below starlight, and black counts as this
  static constexpr float kBrightest = 0x1.ffp+39F;  // above the sun's disc
  static constexpr std::size_t kSteps = 64 * 256;

  static std::size_t step(float luminance) {
    // Written so that NaN becomes the darkest.
    const float x = luminance > kDarkest ? std::min(luminance, kBrightest) : kDarkest;
    return (floatBits(x) - floatBits(kDarkest)) >> kShift;
  }
  static double middle(std::size_t step_index) {
    const auto bits = floatBits(kDarkest) + static_cast<std::uint32_t>(step_index << kShift);
    return 0.5 * (static_cast<double>(floatOf(bits)) + static_cast<double>(floatOf(bits + (1U << kShift))));
  }

  std::vector<std::int64_t> counts_;
};

/// Weights of rows: a fifth at the top edge, where sky is, full at 60 % of the height, three quarters at the
/// bottom.
std::vector<std::int64_t> rowWeights(int height) {
  std::vector<std::int64_t> weights;
  for (int y = 0; y < height; ++y) {
    const double t = (y + 0.5) / height;
    const double weight = t < 0.6 ? 0.2 + 0.8 * (t / 0.6) * (t / 0.6) : 1.0 - 0.25 * (t - 0.6) / 0.4;
    weights.push_back(std::lround(64.0 * weight));
  }
  return weights;
}

/// Weights of columns: full in the centre, half at the edges.
std::vector<std::int64_t> columnWeights(int width) {
  std::vector<std::int64_t> weights;
  for (int x = 0; x < width; ++x) {
    weights.push_back(std::lround(64.0 * (1.0 - std::abs((x + 0.5) / width - 0.5))));
  }
  return weights;
}

}  // namespace

void validate(const ExposureOptions& options) {
  requireWithin("ev100", options.ev100, -16.0, 24.0);
  requireWithin("compensation_ev", options.compensation_ev, -8.0, 8.0);
  requireWithin("min_ev100", options.min_ev100, -16.0, 24.0);
  requireWithin("max_ev100", options.max_ev100, options.min_ev100, 24.0);
}

double saturationLuminance(double ev100) {
  return 1.2 * std::exp2(ev100);
}

double chooseEv100(const LinearImage& image, const ExposureOptions& options) {
  if (options.mode == ExposureMode::kFixed) {
    return options.ev100;
  }
  if (image.data.empty()) {
    return options.min_ev100;
  }
  LuminanceHistogram histogram;
  const std::vector<std::int64_t> row_weights = rowWeights(image.height);
  const std::vector<std::int64_t> column_weights = columnWeights(image.width);
  for (int y = 0; y < image.height; ++y) {
    const float* p = image.at(0, y);
    const std::int64_t row_weight = row_weights[static_cast<std::size_t>(y)];
    for (int x = 0; x < image.width; ++x, p += 3) {
      histogram.add(0.2126F * p[0] + 0.7152F * p[1] + 0.0722F * p[2],
                    row_weight * column_weights[static_cast<std::size_t>(x)]);
    }
  }
  // The sun's disc, a lamp or a black hole in the picture lies in the ends cut off here.
  const double log_mean = histogram.trimmedLogMean(0.05, 0.95);
  const double ev100 =
      log_mean - std::log2(kMeteredPart * saturationLuminance(0.0)) - options.compensation_ev;
  return std::clamp(ev100, options.min_ev100, options.max_ev100);
}

Rgb8Image develop(const LinearImage& image, double ev100) {
  Rgb8Image picture(image.width, image.height);
  const auto scale = static_cast<float>(1.0 / saturationLuminance(ev100));
  const DisplayCurve& curve = DisplayCurve::instance();
  const auto rows = static_cast<std::size_t>(image.height);
  const std::size_t stride = static_cast<std::size_t>(image.width) * 3;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rows, 16),
                    [&](const tbb::blocked_range<std::size_t>& part) {
                      for (std::size_t i = part.begin() * stride; i < part.end() * stride; ++i) {
                        picture.data[i] = curve.encode(image.data[i] * scale);
                      }
                    });
  return picture;
}

}  // namespace sunlit::image
