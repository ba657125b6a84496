#include "sky/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sky/quadrature.h"

namespace sunlit::sky {
namespace {

/// CIE xy of a linear sRGB colour.
Eigen::Vector2d chromaticity(const LinearRgb& colour) {
  Eigen::Matrix3d xyz_from_rgb;  // IEC 61966-2-1
  xyz_from_rgb << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
  const Eigen::Vector3d xyz = xyz_from_rgb * colour.value.matrix().cast<double>();
  return xyz.head<2>() / xyz.sum();
}

TEST(Spectrum, UnattenuatedSunlightIsTheLuminousSolarConstant) {
  // The sRGB matrix of the standard is rounded to four digits.
  EXPECT_NEAR(colourOf(Spectrum::Ones()).luminance(), 126000.0, 1e-3 * 126000.0);
}

TEST(Spectrum, TheSunAboveTheAirIsNearlyWhite) {
  // A black body of 5900 K, the sun's colour temperature above the air, has xy (0.3236, 0.3320) (CIE 15). The
  // bands and the fitted colour matching functions are good for 0.003.
  const Eigen::Vector2d xy = chromaticity(colourOf(Spectrum::Ones()));
  EXPECT_NEAR(xy.x(), 0.3236, 0.003);
  EXPECT_NEAR(xy.y(), 0.3320, 0.003);
}

TEST(Spectrum, SingleBandsHaveTheirColours) {
  const auto band = [](int index) {
    Spectrum spectrum = Spectrum::Zero();
    spectrum[index] = 1.0F;
    return colourOf(spectrum).value;
  };
  EXPECT_GT(band(2)[2], 5.0F * band(2).abs()[1]);  // 455 nm
  EXPECT_GT(band(5)[1], band(5)[0]);               // 545 nm
  EXPECT_GT(band(9)[0], 5.0F * band(9).abs()[1]);  // 665 nm
}

TEST(Spectrum, GamutMappingKeepsLuminanceAndLeavesNothingNegative) {
  const LinearRgb outside(10.0F, 2.0F, -1.0F);
  const LinearRgb inside = inGamut(outside);
  EXPECT_NEAR(inside.luminance(), outside.luminance(), 1e-5);  // rounding of floats
  EXPECT_GE(inside.value.minCoeff(), 0.0F);
  EXPECT_GT(inside.value[0], inside.value[1]);
  const LinearRgb plain(1.0F, 2.0F, 3.0F);
  EXPECT_TRUE((inGamut(plain).value == plain.value).all());
}

TEST(Spectrum, MoleculesScatterAsPublished) {
  // Bodhaine et al. 1999, table 3: optical depth 0.09705 at 550 nm, 0.2211 at 450 nm. Ours are at 545 and 455
  // nm; λ⁻⁴·⁰⁸ carries them over to better than 1 %.
  const Spectrum depth = rayleighOpticalDepth();
  EXPECT_NEAR(depth[5], 0.09705 * std::pow(550.0 / 545.0, 4.08), 0.01 * 0.097);
  EXPECT_NEAR(depth[2], 0.2211 * std::pow(450.0 / 455.0, 4.08), 0.02 * 0.22);
}

TEST(GaussLegendre, IntegratesPolynomialsExactly) {
  double sum = 0.0;
  for (const Node& node : gaussLegendre(5, -1.0, 3.0)) {
    sum += node.weight * std::pow(node.x, 9);  // degree 2 n − 1
  }
  EXPECT_NEAR(sum, (std::pow(3.0, 10) - 1.0) / 10.0, 1e-8);
}

}  // namespace
}  // namespace sunlit::sky
