#include "sunlit/image/shutter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "sunlit/image/exposure_program.h"
#include "sunlit/image/sensor_noise.h"

namespace sunlit::image {
namespace {

TEST(Shutter, ExposureIsThatOfTheLight) {
  EXPECT_NEAR(exposureTime_s(15.0), 0.24e-3, 0.005e-3);
  EXPECT_NEAR(exposureTime_s(12.0), 1.9e-3, 0.05e-3);
  EXPECT_EQ(exposureTime_s(0.0), 1.0 / 30.0);
}

TEST(Shutter, SmearsByTheTimeThatIsAskedForAndDropsAreAlwaysSeenForSome) {
  ShutterOptions options;
  EXPECT_TRUE(options.none());
  EXPECT_EQ(smearTime_s(options, 12.0), 0.0);
  EXPECT_EQ(streakTime_s(options, 12.0), exposureTime_s(12.0));
  options.exposure_ms = 5.0;
  EXPECT_FALSE(options.none());
  EXPECT_EQ(smearTime_s(options, 12.0), 0.005);
  EXPECT_EQ(streakTime_s(options, 12.0), 0.005);
  options.exposure_ms = std::nullopt;
  EXPECT_FALSE(options.none());
  EXPECT_EQ(smearTime_s(options, 0.0), 1.0 / 30.0);
}

TEST(Shutter, IsOfTheCameraWhoseGainRisesOnceItsLensIsWideOpen) {
  const NoiseOptions noise;
  EXPECT_EQ(noise.gain_ev100, 5.9);
  EXPECT_EQ(leastFullEv100(), 5.9);
  double before = kUsualStop;
  for (int tenth = 180; tenth >= 59; --tenth) {
    const double ev100 = 0.1 * tenth;
    // By which the time that it takes fills the sensor at ISO 100.
    const double stop = std::sqrt(exposureTime_s(ev100) * std::exp2(ev100));
    EXPECT_LE(stop, before + 1e-12) << ev100;
    EXPECT_GE(stop, kWidestStop) << ev100;
    EXPECT_EQ(electronsAtSaturation(ev100, noise), noise.full_well_e) << ev100;
    before = stop;
  }
  EXPECT_NEAR(before, kWidestStop, 0.02);  // which is why it has to be the gain from there
  EXPECT_LT(electronsAtSaturation(5.8, noise), noise.full_well_e);
}

TEST(Shutter, RefusesWhatIsOutOfRange) {
  ShutterOptions options;
  options.line_delay_us = -1.0;
  try {
    validate(options);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "line_delay is -1, but must be from 0 to 1000 us");
  }
}

}  // namespace
}  // namespace sunlit::image
