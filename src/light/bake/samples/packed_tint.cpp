#include "light/bake/samples/packed_tint.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sunlit/quantity/photometry.h"

namespace sunlit::light {
namespace {

/// One channel, of luminance 1.
class Scale {
 public:
  /// `white` is the number of 1, and 255 that of `most`.
  Scale(int white, float most)
      : white_(static_cast<float>(white)), step_(std::log(most) / (255.0f - static_cast<float>(white))) {
    values_[0] = 0.0f;
    for (std::size_t i = 1; i < values_.size(); ++i)
      values_[i] = std::exp((static_cast<float>(i) - white_) * step_);
  }
  std::uint8_t pack(float value) const {
    if (!(value > 0.5f * values_[1])) return 0;
    const float number = std::round(white_ + std::log(value) / step_);
    return static_cast<std::uint8_t>(std::clamp(number, 1.0f, 255.0f));
  }
  float operator[](std::uint8_t number) const { return values_[number]; }

 private:
  float white_, step_;
  std::array<float, 256> values_;
};

}  // namespace

/// Of the two channels that are kept.
struct PackedTint::Scales {
  Scale red{kWhiteRed, 1.0f / LinearRgb(1.0f, 0.0f, 0.0f).luminance()};
  Scale blue{kWhiteBlue, 1.0f / LinearRgb(0.0f, 0.0f, 1.0f).luminance()};
  static const Scales& get() {
    static const Scales scales;
    return scales;
  }
};

PackedTint::PackedTint(const Eigen::Array3f& color) {
  const float luminance = LinearRgb(color).luminance();
  if (!(luminance > 0.0f)) return;
  red_ = Scales::get().red.pack(color[0] / luminance);
  blue_ = Scales::get().blue.pack(color[2] / luminance);
}

Eigen::Array3f PackedTint::value() const {
  if (white()) return Eigen::Array3f::Ones();
  const float red = Scales::get().red[red_], blue = Scales::get().blue[blue_];
  const float rest = 1.0f - LinearRgb(red, 0.0f, blue).luminance();
  // Of purples rounding may leave less than no green.
  if (rest < 0.0f) return Eigen::Array3f(red, 0.0f, blue) / (1.0f - rest);
  return {red, rest / LinearRgb(0.0f, 1.0f, 0.0f).luminance(), blue};
}

}  // namespace sunlit::light
