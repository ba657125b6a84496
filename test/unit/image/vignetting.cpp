// What a lens keeps back towards the edge, by angles and published numbers.
#include "sunlit/image/vignetting.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <string>

#include "support/message_of.h"
#include "support/published_lenses.h"

namespace sunlit::image {
namespace {

Lens pinhole(double fov_deg, int width = 641, int height = 481) {
  return Lens(PinholeCamera::fromFieldOfView(width, height, Angle::degrees(fov_deg)), {});
}

VignettingOptions cos4() {
  VignettingOptions options;
  options.cos4 = true;
  return options;
}

LinearImage white(const Lens& lens) {
  LinearImage picture(lens.camera().width, lens.camera().height);
  for (float& value : picture.data) value = 100.0F;
  return picture;
}

TEST(Vignetting, OfAPlainLensGoesWithTheFourthPowerOfTheCosine) {
  const Lens lens = pinhole(90.0);
  const Vignetting vignetting(lens, cos4());
  LinearImage picture = white(lens);
  vignetting.apply(&picture);
  // Published to two digits: 0.78, 0.56, 0.34 at 20, 30, 40 degrees. A pixel nearest to such an angle is off
  // by half a pixel, 0.1 degrees at most, of which cos⁴ makes 0.004.
  const struct {
    double angle_deg, part;
  } rows[] = {{0.0, 1.0}, {20.0, 0.78}, {30.0, 0.5625}, {40.0, 0.3444}};
  for (const auto& row : rows) {
    const double x = 320.0 + lens.camera().fx * std::tan(row.angle_deg * kRadPerDeg);
    EXPECT_NEAR(vignetting.at({x, 240.0}), row.part, 0.0005 + (row.angle_deg == 20.0 ? 0.005 : 0.0));
    EXPECT_NEAR(picture.at(static_cast<int>(std::lround(x)), 240)[1], 100.0 * row.part, 0.9);
  }
}

TEST(Vignetting, GoesByTheTrueRaysOfALens) {
  const PublishedLens euroc = eurocLens();
  const Lens lens = euroc.lens();
  const Vignetting vignetting(lens, cos4());
  const auto ray = lens.unproject({0.0, 0.0});
  ASSERT_TRUE(ray);
  const double cosine = ray->normalized().z();
  EXPECT_NEAR(vignetting.at({0.0, 0.0}), std::pow(cosine, 4), 1e-12);
  // A pinhole would have the corner at another angle: the lens draws it in by a sixth or so.
  const Vignetting straight(Lens(lens.camera(), {}), cos4());
  EXPECT_LT(vignetting.at({0.0, 0.0}), 0.8 * straight.at({0.0, 0.0}));
}

TEST(Vignetting, MeasuredIsOneInTheMiddleAndTheSumInTheFarthestCorner) {
  const Lens lens = pinhole(60.0, 640, 480);
  VignettingOptions options;
  options.a1 = -0.9;
  options.a2 = 0.3;
  options.a3 = -0.17;  // 0.23 in the corner, as a Distagon 2/35 wide open
  const Vignetting vignetting(lens, options);
  EXPECT_NEAR(vignetting.at({319.5, 239.5}), 1.0, 1e-12);
  EXPECT_NEAR(vignetting.at({-0.5, -0.5}), 0.23, 1e-12);
  EXPECT_NEAR(vignetting.at({639.5, 479.5}), 0.23, 1e-12);
  // 320 of 400 px from the middle: r² = 0.64.
  EXPECT_NEAR(vignetting.at({639.5, 239.5}), 1.0 - 0.9 * 0.64 + 0.3 * 0.4096 - 0.17 * 0.262144, 1e-12);
  options.cos4 = true;
  const double cosine = std::cos(30.0 * kRadPerDeg);
  EXPECT_NEAR(Vignetting(lens, options).at({639.5, 239.5}),
              vignetting.at({639.5, 239.5}) * std::pow(cosine, 4), 1e-12);
}

TEST(Vignetting, NoneLeavesEveryBit) {
  const Lens lens = pinhole(90.0);
  LinearImage picture = white(lens);
  picture.data[7] = 3e-9F;
  const LinearImage before = picture;
  const Vignetting none(lens, {});
  EXPECT_TRUE(none.none());
  none.apply(&picture);
  EXPECT_EQ(picture.data, before.data);
}

TEST(Vignetting, HasTheSameBitsForAnyThreadCount) {
  const Lens lens = eurocLens().lens();
  LinearImage parallel = white(lens), alone = white(lens);
  Vignetting(lens, cos4()).apply(&parallel);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  Vignetting(lens, cos4()).apply(&alone);
  EXPECT_EQ(alone.data, parallel.data);
}

TEST(Vignetting, ThatNoLensHasIsRefused) {
  VignettingOptions options;
  options.a1 = -1.5;
  const std::string folded = messageOf([&] { validate(options); });
  EXPECT_EQ(folded.find("a1 is -1.5, but must be such that 1 + a1 r²"), 0u) << folded;
  options.a1 = 11.0;
  EXPECT_EQ(messageOf([&] { validate(options); }), "a1 is 11, but must be from -10 to 10");
  for (const PublishedLens& published : publishedLenses()) {
    const bool beyond = published.lens().widest().deg() >= 90.0;
    const std::string told = messageOf([&] { const Vignetting made(published.lens(), cos4()); });
    EXPECT_EQ(told.empty(), !beyond) << published.name << ": " << told;
    const std::string refused = beyond ? "vignetting is cos4, but must be none before a lens" : "";
    EXPECT_EQ(told.substr(0, refused.size()), refused);
  }
}

}  // namespace
}  // namespace sunlit::image
