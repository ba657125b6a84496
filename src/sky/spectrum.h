/// Light in wavelength bands, and what bands look like to an eye.
#pragma once

#include <Eigen/Core>

#include "sunlit/quantity/photometry.h"

namespace sunlit::sky {

/// 380 … 740 nm in 30 nm steps: narrow enough that Rayleigh's λ⁻⁴ is nearly straight within one.
constexpr int kBands = 12;
constexpr double kFirstBandEdge_nm = 380.0;
constexpr double kBandWidth_nm = 30.0;

/// One value a band. A radiance or irradiance is relative to the sun's irradiance above the atmosphere at 1
/// AU.
using Spectrum = Eigen::Array<float, kBands, 1>;

constexpr double bandCentre_nm(int band) {
  return kFirstBandEdge_nm + (band + 0.5) * kBandWidth_nm;
}

/// Optical depth of the molecules of a whole vertical column at 1013.25 hPa: Bodhaine et al. 1999, eq. 30.
Spectrum rayleighOpticalDepth();

/// Absorption cross-section of ozone at 233 K, m² a molecule (Chappuis bands; band means of Serdyuchenko et
/// al. 2014).
Spectrum ozoneCrossSection_m2();

/// The linear colour of light that holds `relative` times the sun's light of each band: lx for an irradiance,
/// cd/m² for a radiance. Unit input gives kLuminousSolarConstant_lx. May lie outside the gamut (negative
/// parts).
LinearRgb colourOf(const Spectrum& relative);

/// The nearest colour of the same luminance and hue without negative parts.
LinearRgb inGamut(const LinearRgb& colour);

/// The colour of `light` in gamut, and a zero: tables hold four floats, which processors add at once.
Eigen::Array4f paddedColourOf(const Spectrum& light);

/// Illuminance of a plane facing the sun above the atmosphere at 1 AU. The spectrum that the bands are taken
/// from has 133,100 lx (683 lm/W and V(λ) over ASTM G173-03); 126,000 lx is the published value that goes
/// with a sun of V = −26.74 and the zero magnitude below, and measured daylight lies nearer to it.
constexpr double kLuminousSolarConstant_lx = 126000.0;

/// Illuminance of a star of visual magnitude 0 above the atmosphere: Allen's Astrophysical Quantities, 4th
/// ed. (2000), 2.4.
constexpr double kZeroMagnitude_lx = 2.54e-6;

/// Light of `power` by band (any unit of energy), scaled to the luminance of the sun at 1 AU.
Spectrum asBrightAsTheSun(const Spectrum& power);

/// Light of a black body, scaled likewise.
Spectrum blackBody(double temperature_k);

}  // namespace sunlit::sky
