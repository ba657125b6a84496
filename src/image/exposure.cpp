#include "sunlit/image/exposure.h"

#include <tbb/blocked_range.h>
#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "display_curve.h"
#include "sunlit/quantity/photometry.h"

namespace sunlit::image {
namespace {

// The metered mean becomes 18 % of saturation, which is level 118 of 255: standard output sensitivity, ISO
// 12232:2019.
constexpr double kMeteredPart = 0.18;
/// Metered luminance, log2 of cd/m², below which a picture is to look like dusk, and how dark it may get.
constexpr double kDuskLogLuminance = 6.0;
constexpr double kLargestDarkening = 3.5;  // stops
/// Part of saturation at which a channel begins to burn out: sky that is closer loses its colour.
constexpr double kBurningPart = 0.7;
/// Stops above that beyond which a pixel, such as of the sun's disc, is not missed any more.
constexpr double kLargestBurn = 4.0;

/// How much there is of each of several luminances, from the darkest on.
class LuminanceSpread {
 public:
  void add(double log_luminance, double count) { bins_.push_back({log_luminance, count}); }

  /// Mean over the whole weight of the octaves by which luminances exceed 2^`log_limit`, each counted up to
  /// `most`.
  double meanExcess(double log_limit, double most) const {
    double total = 0.0;
    double sum = 0.0;
    for (const Bin& bin : bins_) {
      total += bin.count;
      sum += bin.count * std::clamp(bin.log_luminance - log_limit, 0.0, most);
    }
    return sum / total;
  }

  /// Mean of log2(luminance) of the weight between the two parts of the whole. At least one pixel was added.
  double trimmedLogMean(double low_part, double high_part) const {
    double total = 0.0;
    for (const Bin& bin : bins_) total += bin.count;
    const double low = low_part * total;
    const double high = high_part * total;
    double before = 0.0;
    double sum = 0.0;
    for (const Bin& bin : bins_) {
      const double after = before + bin.count;
      const double inside = std::min(after, high) - std::max(before, low);
      if (inside > 0.0) sum += inside * bin.log_luminance;
      before = after;
    }
    return sum / (high - low);
  }

 private:
  struct Bin {
    double log_luminance;  ///< log2 of cd/m²
    double count;
  };
  std::vector<Bin> bins_;
};

/// Luminances counted by the leading bits of their float: 256 steps an octave, without a logarithm a pixel.
/// Counts are integers, so the order of pixels does not matter.
class LuminanceHistogram {
 public:
  LuminanceHistogram() : counts_(kSteps, 0) {}

  void add(float luminance, std::int64_t weight) { counts_[step(luminance)] += weight; }
  void add(const LuminanceHistogram& other) {
    for (std::size_t i = 0; i < kSteps; ++i) counts_[i] += other.counts_[i];
  }

  LuminanceSpread spread() const {
    LuminanceSpread spread;
    for (std::size_t i = 0; i < kSteps; ++i)
      if (counts_[i] != 0) spread.add(logMiddle(i), static_cast<double>(counts_[i]));
    return spread;
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
  static double logMiddle(std::size_t step_index) {
    const auto bits = floatBits(kDarkest) + static_cast<std::uint32_t>(step_index << kShift);
    return std::log2(
        0.5 * (static_cast<double>(floatOf(bits)) + static_cast<double>(floatOf(bits + (1U << kShift)))));
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

/// A picture's luminances by their weights, and its pixels' largest channels.
struct Counts {
  LuminanceHistogram metered, largest;
};

Counts countsOf(const LinearImage& image) {
  const std::vector<std::int64_t> row_weights = rowWeights(image.height);
  const std::vector<std::int64_t> column_weights = columnWeights(image.width);
  tbb::combinable<Counts> parts;
  tbb::parallel_for(tbb::blocked_range<int>(0, image.height, 16), [&](const auto& rows) {
    Counts& counts = parts.local();
    for (int y = rows.begin(); y < rows.end(); ++y) {
      const float* p = image.at(0, y);
      const std::int64_t row_weight = row_weights[static_cast<std::size_t>(y)];
      for (int x = 0; x < image.width; ++x, p += 3) {
        counts.metered.add(LinearRgb(p[0], p[1], p[2]).luminance(),
                           row_weight * column_weights[static_cast<std::size_t>(x)]);
        counts.largest.add(std::max({p[0], p[1], p[2]}), 1);
      }
    }
  });
  Counts all;
  parts.combine_each([&](const Counts& part) {
    all.metered.add(part.metered);
    all.largest.add(part.largest);
  });
  return all;
}

/// By how many stops an exposure of `ev100` is to be cut: d = strength · (mean burn at ev100 + d). The burn
/// falls as d grows, so there is one answer, and it moves continuously with every pixel's light.
double highlightCut(const LuminanceSpread& largest, double ev100, double strength) {
  const double log_limit = std::log2(kBurningPart * saturationLuminance(ev100));
  double low = 0.0;
  double high = strength * largest.meanExcess(log_limit, kLargestBurn);
  for (int i = 0; i < 30 && high - low > 1e-4; ++i) {
    const double middle = 0.5 * (low + high);
    (strength * largest.meanExcess(log_limit + middle, kLargestBurn) > middle ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

void validate(const ExposureOptions& options) {
  requireFields(options);
  require("max_ev100", options.max_ev100, {options.min_ev100, 24.0}, "EV");
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
  const Counts counts = countsOf(image);
  const LuminanceSpread metered = counts.metered.spread(), largest = counts.largest.spread();
  // The sun's disc, a lamp or a black hole in the picture lies in the ends cut off here.
  const double log_mean = metered.trimmedLogMean(0.05, 0.95);
  const double darkening =
      std::clamp(options.night_darkening * (kDuskLogLuminance - log_mean), 0.0, kLargestDarkening);
  const double ev100 = log_mean - std::log2(kMeteredPart * saturationLuminance(0.0)) + darkening;
  const double cut = highlightCut(largest, ev100, options.highlight_protection);
  return std::clamp(ev100 + cut - options.compensation_ev, options.min_ev100, options.max_ev100);
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
