#include "sky/medium.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit::sky {
namespace {

Spectrum verticalDepth(const Medium& medium) {
  Spectrum depth = Spectrum::Zero();
  constexpr double kStep_km = 0.02;
  for (int i = 0; i < 5000; ++i) {
    depth += medium.at((i + 0.5) * kStep_km).extinction * static_cast<float>(kStep_km);
  }
  return depth;
}

/// ∫ phase dω and ∫ phase · cos dω over the sphere.
template <typename Phase>
Eigen::Vector2d moments(const Phase& phase) {
  constexpr int kSteps = 20000;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int i = 0; i < kSteps; ++i) {
    const double cos_angle = -1.0 + 2.0 * (i + 0.5) / kSteps;
    sum +=
        Eigen::Vector2d(1.0, cos_angle) * (phase(static_cast<float>(cos_angle)) * 2.0 * kPi * 2.0 / kSteps);
  }
  return sum;
}

TEST(Medium, ItsColumnHoldsWhatWasAskedFor) {
  MediumParameters parameters;
  parameters.turbidity = 3.0;
  const Spectrum column = verticalDepth(Medium(parameters));
  const float ozone_per_m2 = static_cast<float>(300.0 * 2.6867e20 * 1e-25);
  const Spectrum wanted =
      rayleighOpticalDepth() + aerosolOpticalDepth(3.0) + (ozoneCrossSection_m2() * 1e25F) * ozone_per_m2;
  // 100 m layers, straight between: the aerosol's exponential comes out 0.06 % high.
  for (int band = 0; band < kBands; ++band) {
    EXPECT_NEAR(column[band], wanted[band], 2e-3F * wanted[band]) << band;
  }
}

TEST(Medium, PureAirHasNoAerosol) {
  // β of turbidity 1 is 0.0002.
  EXPECT_LT(aerosolOpticalDepth(1.0).maxCoeff(), 1e-3F);
  EXPECT_NEAR(aerosolOpticalDepth(3.0)[5], 0.09238 * std::pow(0.545, -1.3), 1e-5);
}

TEST(Medium, PhaseFunctionsIntegrateToOne) {
  const Eigen::Vector2d rayleigh = moments(rayleighPhase);
  EXPECT_NEAR(rayleigh[0], 1.0, 1e-5);  // the sum's own error
  EXPECT_NEAR(rayleigh[1], 0.0, 1e-5);
  const Eigen::Vector2d aerosol = moments(aerosolPhase);
  EXPECT_NEAR(aerosol[0], 1.0, 1e-4);
  EXPECT_NEAR(aerosol[1], 0.6 * 0.82 + 0.4 * 0.5, 1e-4);  // of its two lobes
  EXPECT_NEAR(moments(aerosolAgainPhase)[0], 1.0, 1e-3);  // tabulated
  for (const float cos_angle : {-1.0F, -0.3F, 0.6F, 0.95F, 0.999F, 1.0F}) {
    EXPECT_NEAR(aerosolPhases(cos_angle).once, aerosolPhase(cos_angle), 3e-3F * aerosolPhase(cos_angle));
  }
  // The table meets directions that rounding made a little longer than unit vectors.
  EXPECT_FLOAT_EQ(aerosolPhases(1.0001F).once, aerosolPhases(1.0F).once);
  const std::array<float, 5> wide = aerosolWideMoments();
  EXPECT_NEAR(wide[1], moments(aerosolWidePhase)[1], 1e-3);  // two sums
  EXPECT_NEAR(moments(aerosolWidePhase)[0], 1.0 - kAerosolForwardPart,
              1e-3);  // its limit is found by a sum too
}

TEST(Medium, ScalingTakesOutJustTheForwardPart) {
  const LocalMedium local = Medium(MediumParameters{}).at(0.5);
  const Spectrum forward = local.aerosol_scattering * kAerosolForwardPart;
  for (int band = 0; band < kBands; ++band) {
    EXPECT_NEAR(local.extinction[band] - local.scaled_extinction[band], forward[band], 1e-6F);
  }
}

}  // namespace
}  // namespace sunlit::sky
