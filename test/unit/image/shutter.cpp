#include "sunlit/image/shutter.h"

#include <gtest/gtest.h>

#include <stdexcept>

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
