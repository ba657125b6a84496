#include "sunlit/image/exposure.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "image/display_curve.h"
#include "support/message_of.h"

namespace sunlit::image {
namespace {

LinearImage grey(int width, int height, float luminance) {
  LinearImage image(width, height);
  for (float& value : image.data) {
    value = luminance;
  }
  return image;
}

/// Ground below, sky above, with a repeatable texture of ± 30 %.
LinearImage landscape(float sky, float ground) {
  LinearImage image(320, 240);
  std::uint32_t state = 1;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      state = state * 1664525U + 1013904223U;
      const float texture = 0.7F + 0.6F * static_cast<float>(state >> 8) / static_cast<float>(1U << 24);
      for (int channel = 0; channel < 3; ++channel) {
        image.at(x, y)[channel] = texture * (y < 110 ? sky : ground);
      }
    }
  }
  return image;
}

std::string messageOf(const ExposureOptions& options) {
  return sunlit::messageOf([&] { validate(options); });
}

TEST(DisplayCurve, EqualsTheExactCurveAtEveryStepAndBetween) {
  const DisplayCurve& curve = DisplayCurve::instance();
  // Both are monotonic, so equality on both sides of all 255 steps is equality everywhere.
  int steps = 0;
  std::uint32_t low = 0;
  for (int level = 1; level <= 255; ++level) {
    std::uint32_t high = floatBits(1.0F);
    while (high - low > 1) {
      const std::uint32_t middle = low + (high - low) / 2;
      (exactLevel(floatOf(middle)) < level ? low : high) = middle;
    }
    ASSERT_EQ(exactLevel(floatOf(high)), level);
    EXPECT_EQ(curve.encode(floatOf(high)), level);
    EXPECT_EQ(curve.encode(floatOf(high - 1)), level - 1);
    ++steps;
  }
  EXPECT_EQ(steps, 255);
  for (std::uint32_t bits = 0; bits <= floatBits(1.0F); bits += 4093) {  // a prime, so that all cells are met
    ASSERT_EQ(curve.encode(floatOf(bits)), exactLevel(floatOf(bits))) << floatOf(bits);
  }
}

TEST(DisplayCurve, ClipsWhatNoDisplayCanShow) {
  const DisplayCurve& curve = DisplayCurve::instance();
  EXPECT_EQ(curve.encode(-1.0F), 0);
  EXPECT_EQ(curve.encode(0.0F), 0);
  EXPECT_EQ(curve.encode(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(curve.encode(1.0F), 255);
  EXPECT_EQ(curve.encode(std::numeric_limits<float>::infinity()), 255);
}

TEST(Develop, SaturatesJustAtTheSaturationLuminance) {
  for (const double ev100 : {-6.0, 0.0, 13.0}) {
    const auto saturating = static_cast<float>(saturationLuminance(ev100));
    EXPECT_EQ(develop(grey(2, 2, saturating), ev100).data.front(), 255);
    // Level 254.5 lies at a linear 0.99555, so 0.99 of it is below white.
    EXPECT_LT(develop(grey(2, 2, 0.99F * saturating), ev100).data.front(), 255);
  }
}

TEST(Develop, OneStopMoreIsHalfTheLight) {
  const LinearImage image = landscape(5000.0F, 900.0F);
  LinearImage twice = image;
  for (float& value : twice.data) {
    value *= 2.0F;
  }
  EXPECT_EQ(develop(image, 12.0).data, develop(twice, 13.0).data);
}

TEST(Develop, SameBitsForAnyThreadCount) {
  const LinearImage image = landscape(5000.0F, 900.0F);
  const Rgb8Image parallel = develop(image, 13.0);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(develop(image, 13.0).data, parallel.data);
}

TEST(Exposure, FixedIsWhatWasAskedFor) {
  ExposureOptions options;
  options.mode = ExposureMode::kFixed;
  options.ev100 = 7.5;
  EXPECT_EQ(chooseEv100(grey(4, 4, 1e5F), options), 7.5);
}

TEST(Exposure, EvenGreyBecomesMiddleGrey) {
  for (const float luminance : {70.0F, 300.0F, 9000.0F}) {
    const LinearImage image = grey(64, 48, luminance);
    const double ev100 = chooseEv100(image, {});
    // One histogram step is 1/256 octave: half of it is 0.003 stops.
    EXPECT_NEAR(luminance / saturationLuminance(ev100), 0.18, 0.18 * 0.003);
    EXPECT_EQ(develop(image, ev100).data.front(), 118);
  }
}

TEST(Exposure, DuskLooksDarkerThanDay) {
  // 0.15 stops for each stop below 64 cd/m², but no more than 3.5.
  const struct {
    float luminance;
    double darker;
  } cases[] = {{64.0F, 0.0}, {32.0F, 0.15}, {1.0F, 0.9}, {0x1p-10F, 2.4}, {0x1p-18F, 3.5}};
  ExposureOptions options;
  options.min_ev100 = -16.0;
  ExposureOptions plain = options;
  plain.night_darkening = 0.0;
  for (const auto& c : cases) {
    const LinearImage image = grey(64, 48, c.luminance);
    // One histogram step is 1/256 octave: half of it counts 0.15 · 0.002.
    EXPECT_NEAR(chooseEv100(image, options) - chooseEv100(image, plain), c.darker, 0.001) << c.luminance;
  }
}

TEST(Exposure, NothingJumpsWhileTheLightFades) {
  double before = chooseEv100(landscape(20000.0F, 200.0F), {});
  for (double stops = 0.02; stops < 30.0; stops += 0.02) {
    const auto light = static_cast<float>(std::exp2(-stops));
    // The sky fades faster than the ground, so that it stops burning out on the way.
    const double now = chooseEv100(landscape(20000.0F * light, 200.0F * std::sqrt(light)), {});
    // 0.02 stops of light, once more for what the highlights do.
    ASSERT_NEAR(now, before, 0.04) << stops;
    before = now;
  }
}

TEST(Exposure, ABurningSkyIsHeldBack) {
  // A shaded ground, and behind it a sky 30 times as bright in 46 % of the picture.
  const LinearImage image = landscape(6000.0F, 200.0F);
  ExposureOptions plain;
  plain.highlight_protection = 0.0;
  const double burning = chooseEv100(image, plain);
  const double held = chooseEv100(image, {});
  EXPECT_GT(6000.0, 2.0 * saturationLuminance(burning));
  // d = 10 · 0.46 · (over − d) has d = 0.82 over; the texture of the sky, ± 30 %, moves it a little.
  const double over = std::log2(6000.0 / (0.7 * saturationLuminance(burning)));
  EXPECT_NEAR(held - burning, 0.82 * over, 0.1 * over);
}

TEST(Exposure, FollowsTheLightStopByStop) {
  const double dim = chooseEv100(landscape(500.0F, 90.0F), {});
  const double bright = chooseEv100(landscape(2000.0F, 360.0F), {});
  EXPECT_NEAR(bright - dim, 2.0, 2e-4);  // the cut for highlights is found within 1e-4
}

TEST(Exposure, ASkyTenTimesBrighterCostsTheGroundLessThanAStopAndAHalf) {
  // The sky fills 46 % of the picture but holds 26 % of the metering weight: log2(10) · 0.26 = 0.86. By that
  // it comes near to burning out, which is worth half a stop more.
  const double plain = chooseEv100(landscape(1000.0F, 1000.0F), {});
  const double contrast = chooseEv100(landscape(10000.0F, 1000.0F), {});
  EXPECT_GT(contrast, plain);
  EXPECT_LT(contrast - plain, 1.5);
}

TEST(Exposure, TheSunsDiscInThePictureChangesNearlyNothing) {
  LinearImage image = landscape(5000.0F, 900.0F);
  const double without = chooseEv100(image, {});
  for (int y = 40; y < 52; ++y) {
    for (int x = 150; x < 162; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        image.at(x, y)[channel] = 1.6e9F;
      }
    }
  }
  // 0.19 % of the picture, 18 stops brighter: by a plain mean it would be 11 stops. What is left is the cut
  // for highlights, 10 · 0.19 % · 4 stops.
  EXPECT_NEAR(chooseEv100(image, {}), without, 0.08);
}

TEST(Exposure, StaysWithinItsLimits) {
  ExposureOptions options;
  EXPECT_EQ(chooseEv100(grey(8, 8, 0.0F), options), options.min_ev100);
  EXPECT_EQ(chooseEv100(grey(8, 8, 1e12F), options), options.max_ev100);
  EXPECT_EQ(chooseEv100(grey(8, 8, std::numeric_limits<float>::quiet_NaN()), options), options.min_ev100);
  EXPECT_EQ(chooseEv100(grey(8, 8, std::numeric_limits<float>::infinity()), options), options.max_ev100);
  EXPECT_EQ(chooseEv100(LinearImage(), options), options.min_ev100);
}

TEST(Exposure, CompensationBrightens) {
  ExposureOptions options;
  const double plain = chooseEv100(grey(8, 8, 100.0F), options);
  options.compensation_ev = 1.5;
  EXPECT_DOUBLE_EQ(chooseEv100(grey(8, 8, 100.0F), options), plain - 1.5);
}

TEST(ExposureOptions, BadValuesAreNamedWithTheirRange) {
  EXPECT_EQ(messageOf({}), "");
  ExposureOptions options;
  options.ev100 = 25.0;
  EXPECT_EQ(messageOf(options), "ev100 is 25, but must be from -16 to 24 EV");
  options = {};
  options.compensation_ev = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(messageOf(options), "compensation is nan, but must be from -8 to 8 EV");
  options = {};
  options.night_darkening = 0.6;
  EXPECT_EQ(messageOf(options), "night_darkening is 0.6, but must be from 0 to 0.5");
  options = {};
  options.highlight_protection = -1.0;
  EXPECT_EQ(messageOf(options), "highlight_protection is -1, but must be from 0 to 20");
  options = {};
  options.max_ev100 = -9.0;
  EXPECT_EQ(messageOf(options), "max_ev100 is -9, but must be from -8 to 24 EV");
  options = {};
  options.min_ev100 = -17.0;
  EXPECT_EQ(messageOf(options), "min_ev100 is -17, but must be from -16 to 24 EV");
}

}  // namespace
}  // namespace sunlit::image
