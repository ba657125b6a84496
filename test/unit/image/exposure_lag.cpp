#include "sunlit/image/exposure_lag.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sunlit::image {
namespace {

ExposureOptions options(double adaptation, int delay) {
  ExposureOptions options;
  options.adaptation = adaptation;
  options.delay = delay;
  return options;
}

/// Of pictures 0 … of which the first `dark` meter 3, the others 15.
double metered(std::int64_t index, std::int64_t dark) {
  return index < dark ? 3.0 : 15.0;
}

/// EV of picture `index` of a run that begins at `first`, which then begins with what firstMissing() asks
/// for.
double ofRun(const ExposureOptions& options, std::int64_t first, std::int64_t index) {
  ExposureLag lag(options);
  for (std::int64_t i = first; i <= index; ++i) {
    for (std::int64_t j = lag.firstMissing(i); j <= i; ++j) lag.add(j, metered(j, 40));
  }
  return lag.ev100();
}

TEST(ExposureLag, WithoutItEachPictureHasWhatItMeters) {
  ExposureLag lag(options(1.0, 0));
  EXPECT_EQ(lag.memory(), 0);
  EXPECT_EQ(lag.firstMissing(7), 7);
  lag.add(7, 12.5);
  EXPECT_EQ(lag.ev100(), 12.5);
  lag.add(90, 3.25);
  EXPECT_EQ(lag.ev100(), 3.25);
}

TEST(ExposureLag, OfAStepOfThreeStopsIsLeftWhatAnExponentialLeaves) {
  // 3 (1 − k)^n, the notes' closed form; n counts from the first picture that meters the new light.
  const ExposureOptions slow = options(0.2, 0);
  ExposureLag lag(slow);
  EXPECT_EQ(lag.memory(), 26);
  for (int i = 0; i < 30; ++i) lag.add(i, 10.0);
  for (int n = 1; n <= 20; ++n) {
    lag.add(29 + n, 13.0);
    EXPECT_NEAR(13.0 - lag.ev100(), 3.0 * std::pow(0.8, n), 1e-12) << n;
  }
}

TEST(ExposureLag, ActsAfterItsDelay) {
  ExposureLag lag(options(1.0, 3));
  EXPECT_EQ(lag.memory(), 3);
  for (int i = 0; i < 10; ++i) lag.add(i, 10.0);
  for (int i = 10; i < 13; ++i) {
    lag.add(i, 13.0);
    EXPECT_EQ(lag.ev100(), 10.0) << i;
  }
  lag.add(13, 13.0);
  EXPECT_EQ(lag.ev100(), 13.0);
}

TEST(ExposureLag, APictureIsTheSameWhereverTheRunBegan) {
  for (const auto& [adaptation, delay] : {std::pair{0.2, 0}, {0.68, 3}, {1.0, 2}, {0.05, 10}}) {
    const ExposureOptions slow = options(adaptation, delay);
    for (const std::int64_t index : {0, 1, 39, 40, 43, 60, 200})
      for (const std::int64_t first : {index / 2, index}) {
        EXPECT_EQ(ofRun(slow, first, index), ofRun(slow, 0, index)) << adaptation << " " << index;
      }
  }
}

TEST(ExposureLag, NeedsNoMoreThanItRemembers) {
  ExposureLag lag(options(0.68, 0));
  const int memory = lag.memory();
  EXPECT_EQ(memory, 6);
  EXPECT_EQ(lag.firstMissing(3), 0);
  EXPECT_EQ(lag.firstMissing(100), 100 - memory);
  for (std::int64_t i = 100 - memory; i <= 100; ++i) lag.add(i, 10.0);
  EXPECT_EQ(lag.firstMissing(101), 101);
  EXPECT_EQ(lag.firstMissing(103), 101);
  EXPECT_EQ(lag.firstMissing(110), 110 - memory);
  EXPECT_EQ(lag.firstMissing(50), 50 - memory);  // gone back
}

TEST(ExposureLag, AFixedExposureHasNone) {
  ExposureOptions fixed = options(0.2, 3);
  fixed.mode = ExposureMode::kFixed;
  EXPECT_EQ(ExposureLag(fixed).memory(), 0);
}

}  // namespace
}  // namespace sunlit::image
