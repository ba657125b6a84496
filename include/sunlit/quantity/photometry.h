/// Linear, photometric colour.
#pragma once

#include <Eigen/Core>

#include "sunlit/quantity/eigen_ranges.h"

namespace sunlit {

/// Linear RGB with sRGB (Rec. 709) primaries and D65 white. Of what (reflectance, cd/m², lx) is said where it
/// is used; scaled so that luminance() is the photometric quantity: white of 100 cd/m² is (100, 100, 100).
/// Never holds display values: those are 8-bit and live in image::Rgb8Image.
struct LinearRgb {
  Eigen::Array3f value = Eigen::Array3f::Zero();

  LinearRgb() = default;
  explicit LinearRgb(const Eigen::Array3f& rgb) : value(rgb) {}
  LinearRgb(float r, float g, float b) : value(r, g, b) {}

  /// Y of CIE 1931 by the Rec. 709 weights (ITU-R BT.709-6, item 3.2).
  float luminance() const { return 0.2126f * value[0] + 0.7152f * value[1] + 0.0722f * value[2]; }

  LinearRgb operator+(const LinearRgb& other) const { return LinearRgb(value + other.value); }
  LinearRgb operator*(const LinearRgb& other) const { return LinearRgb(value * other.value); }
  LinearRgb operator*(float factor) const { return LinearRgb(value * factor); }
};

}  // namespace sunlit
