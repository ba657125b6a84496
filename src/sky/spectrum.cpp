#include "spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sunlit::sky {
namespace {

/// Solar irradiance above the atmosphere, W/m²/nm: band means of ASTM G173-03, column 1.
constexpr std::array<double, kBands> kSunIrradiance = {1.296, 1.677, 1.989, 1.971, 1.872, 1.865,
                                                       1.828, 1.744, 1.644, 1.530, 1.444, 1.341};

double lobe(double wavelength_nm, double centre_nm, double below_nm, double above_nm) {
  const double t = (wavelength_nm - centre_nm) / (wavelength_nm < centre_nm ? below_nm : above_nm);
  return std::exp(-0.5 * t * t);
}

/// CIE 1931 2° colour matching functions x̄ ȳ z̄: Wyman, Sloan, Shirley 2013, multi-lobe fit.
Eigen::Vector3d colourMatching(double nm) {
  return {1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
              0.065 * lobe(nm, 501.1, 20.4, 26.2),
          0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
          1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

using RgbFromBands = Eigen::Matrix<float, 3, kBands>;

RgbFromBands makeRgbFromBands() {
  Eigen::Matrix<double, 3, kBands> xyz = Eigen::Matrix<double, 3, kBands>::Zero();
  for (int band = 0; band < kBands; ++band) {
    for (int nm = 0; nm < static_cast<int>(kBandWidth_nm); ++nm) {
      xyz.col(band) += kSunIrradiance[static_cast<std::size_t>(band)] *
                       colourMatching(kFirstBandEdge_nm + band * kBandWidth_nm + nm + 0.5);
    }
  }
  xyz *= kLuminousSolarConstant_lx / xyz.row(1).sum();
  Eigen::Matrix3d rgb_from_xyz;  // IEC 61966-2-1
  rgb_from_xyz << 3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570;
  return (rgb_from_xyz * xyz).cast<float>();
}

}  // namespace

Spectrum rayleighOpticalDepth() {
  Spectrum depth;
  for (int band = 0; band < kBands; ++band) {
    const double um2 = std::pow(bandCentre_nm(band) * 1e-3, 2);
    depth[band] = static_cast<float>(0.0021520 * (1.0455996 - 341.29061 / um2 - 0.90230850 * um2) /
                                     (1.0 + 0.0027059889 / um2 - 85.968563 * um2));
  }
  return depth;
}

Spectrum ozoneCrossSection_m2() {
  Spectrum section;
  section << 0.008e-25F, 0.056e-25F, 0.252e-25F, 0.723e-25F, 1.74e-25F, 3.12e-25F, 4.45e-25F, 4.68e-25F,
      3.21e-25F, 1.85e-25F, 0.966e-25F, 0.527e-25F;
  return section;
}

LinearRgb colourOf(const Spectrum& relative) {
  static const RgbFromBands rgb_from_bands = makeRgbFromBands();
  Eigen::Array3f rgb = Eigen::Array3f::Zero();
  for (int band = 0; band < kBands; ++band) {
    rgb += rgb_from_bands.col(band).array() * relative[band];
  }
  return LinearRgb(rgb);
}

Eigen::Array4f paddedColourOf(const Spectrum& light) {
  const LinearRgb colour = inGamut(colourOf(light));
  return {colour.value[0], colour.value[1], colour.value[2], 0.0F};
}

Spectrum asBrightAsTheSun(const Spectrum& power) {
  Spectrum relative;
  for (int band = 0; band < kBands; ++band) {
    relative[band] = power[band] / static_cast<float>(kSunIrradiance[static_cast<std::size_t>(band)]);
  }
  return relative * (colourOf(Spectrum::Ones()).luminance() / colourOf(relative).luminance());
}

Spectrum blackBody(double temperature_k) {
  constexpr double kSecondRadiation_um_k = 1.438777e4;  // CODATA 2018
  Spectrum power;
  for (int band = 0; band < kBands; ++band) {
    const double um = bandCentre_nm(band) * 1e-3;
    power[band] =
        static_cast<float>(std::pow(um, -5.0) / std::expm1(kSecondRadiation_um_k / (um * temperature_k)));
  }
  return asBrightAsTheSun(power);
}

LinearRgb inGamut(const LinearRgb& colour) {
  const float lowest = colour.value.minCoeff();
  const float grey = colour.luminance();
  if (lowest >= 0.0F) {
    return colour;
  }
  if (grey <= 0.0F) {
    return {};
  }
  // Mix with grey of the same luminance until the lowest part is just zero.
  const float keep = grey / (grey - lowest);
  return LinearRgb((grey + (colour.value - grey) * keep).max(0.0F));
}

}  // namespace sunlit::sky
