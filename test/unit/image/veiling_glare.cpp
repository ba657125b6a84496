// What a lens strews over the picture, on paper.
#include "sunlit/image/veiling_glare.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "support/message_of.h"
#include "support/published_lenses.h"

namespace sunlit::image {
namespace {

/// The usual camera: 60 x 46.8 degrees.
Lens usual() {
  return Lens(PinholeCamera::fromFieldOfView(640, 480, Angle::degrees(60.0)), {});
}

GlareOptions glare(double share, double wings = 0.5, double hood_deg = 60.0) {
  return {share, wings, Angle::degrees(hood_deg)};
}

VeilingGlare before(const Lens& lens, const GlareOptions& options, bool cos4 = false) {
  VignettingOptions vignetting;
  vignetting.cos4 = cos4;
  return VeilingGlare(Vignetting(lens, vignetting), options);
}

LinearImage even(const Lens& lens, float luminance) {
  LinearImage picture(lens.camera().width, lens.camera().height);
  for (float& value : picture.data) value = luminance;
  return picture;
}

/// Of the first channel.
double sumOf(const LinearImage& picture) {
  double sum = 0.0;
  for (std::size_t i = 0; i < picture.data.size(); i += 3) sum += picture.data[i];
  return sum;
}

LightOutside at(double right_deg, double up_deg, float lux = 1e5F) {
  const double x = std::tan(right_deg * kRadPerDeg), y = -std::tan(up_deg * kRadPerDeg);
  return {Eigen::Vector3d(x, y, 1.0).normalized(), LinearRgb(lux, lux, lux)};
}

TEST(VeilingGlare, OfNoShareLeavesEveryBit) {
  LinearImage picture = even(usual(), 0.1F);
  picture.data[0] = std::numeric_limits<float>::quiet_NaN();
  picture.data[1] = -3.0F;
  const VeilingGlare none = before(usual(), glare(0.0));
  EXPECT_TRUE(none.none());
  none.apply({at(31.0, 0.0)}, &picture);
  EXPECT_TRUE(std::isnan(picture.data[0]));
  EXPECT_EQ(picture.data[1], -3.0F);
  EXPECT_EQ(picture.data[2], 0.1F);
}

TEST(VeilingGlare, KeepsTheLight) {
  // Wherever it is: a sun in a corner, in the middle, at an edge. Sums of floats are off by less than 1e-5.
  const int places[][2] = {{0, 0}, {320, 240}, {639, 200}, {3, 479}};
  for (const auto& [x, y] : places) {
    for (const double wings : {0.0, 0.5, 1.0}) {
      LinearImage picture = even(usual(), 1000.0F);
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = 1.6e9F;
      const double sum = sumOf(picture);
      before(usual(), glare(0.2, wings)).apply({}, &picture);
      EXPECT_NEAR(sumOf(picture) / sum, 1.0, 1e-4) << x << " " << y << " " << wings;
    }
  }
}

TEST(VeilingGlare, KeepsTheLightOfPicturesOfAnySize) {
  for (const auto& [width, height] : {std::pair(16, 16), std::pair(17, 400), std::pair(753, 31)}) {
    const Lens lens(PinholeCamera::fromFieldOfView(width, height, Angle::degrees(60.0)), {});
    LinearImage picture = even(lens, 2.0F);
    for (int c = 0; c < 3; ++c) picture.at(1, height - 1)[c] = 1e6F;
    const double sum = sumOf(picture);
    before(lens, glare(0.05)).apply({}, &picture);
    EXPECT_NEAR(sumOf(picture) / sum, 1.0, 1e-4) << width << " x " << height;
  }
}

TEST(VeilingGlare, IsWhatABlackSpotInAWhiteSphereShows) {
  // ISO 9358. The spot of 5 x 5 px is 25 of 307,200, and what is missing around it, of wings of 4.6 px and
  // more in six parts, is less than a tenth of those.
  LinearImage picture = even(usual(), 1000.0F);
  for (int y = 238; y < 243; ++y)
    for (int x = 318; x < 323; ++x)
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = 0.0F;
  LinearImage with_wings = picture;
  before(usual(), glare(0.03, 0.0)).apply({}, &picture);
  EXPECT_NEAR(picture.at(320, 240)[1], 30.0, 0.01);
  EXPECT_NEAR(picture.at(10, 10)[1], 1000.0, 0.01);
  before(usual(), glare(0.03)).apply({}, &with_wings);
  EXPECT_NEAR(with_wings.at(320, 240)[1], 30.0, 1.5);
  EXPECT_LT(with_wings.at(320, 240)[1], 30.0);
}

/// A picture in which nothing shines but a disc of 1e5 lx, that lies in one pixel.
LinearImage sunAt(const Lens& lens, int x, int y) {
  LinearImage picture = even(lens, 0.0F);
  const double cosine = lens.unproject({1.0 * x, 1.0 * y})->normalized().z();
  const double pixel_sr = std::pow(cosine, 3) / (lens.camera().fx * lens.camera().fy);
  for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = static_cast<float>(1e5 / pixel_sr);
  return picture;
}

TEST(VeilingGlare, OfTheSunInThePictureIs1250PerPercent) {
  // 1e5 lx from 0.7996 sr, 60 x 46.8 degrees, are 125,000 cd/m² in the mean over all places where it may be.
  // On the axis a pixel is larger, f² / N = 1.0000 sr⁻¹, so 1,000 there, and 1,540 at the right edge.
  const Lens lens = usual();
  double sum = 0.0, weight = 0.0;
  for (int y = 3; y < 480; y += 6) {
    for (int x = 3; x < 640; x += 6) {
      const double cosine = lens.unproject({1.0 * x, 1.0 * y})->normalized().z();
      sum += 1e5 / 307200.0 * lens.camera().fx * lens.camera().fy;  // times the pixel, over the pixel
      weight += std::pow(cosine, 3);
    }
  }
  EXPECT_NEAR(sum / weight, 125000.0, 500.0);  // 1e5 / 0.7996 is 125,060; in steps of 6 px
  for (const auto& [x, told] : {std::pair(320, 1000.0), std::pair(639, 1537.0)}) {
    LinearImage picture = sunAt(lens, x, 240);
    before(lens, glare(0.01, 0.0)).apply({}, &picture);
    EXPECT_NEAR(picture.at(100, 100)[1], told, 0.005 * told);
  }
}

TEST(VeilingGlare, PassesOverTheEdgeOfThePictureWithoutAStep) {
  const Lens lens = usual();
  for (const bool cos4 : {false, true}) {
    VignettingOptions options;
    options.cos4 = cos4;
    const Vignetting vignetting(lens, options);
    const VeilingGlare veil(vignetting, glare(0.01));
    const struct {
      int x, y;
      double right_deg, up_deg;
    } edges[] = {{639, 240, 30.001, 0.0}, {320, 0, 0.0, 23.42}, {0, 0, -30.0, 23.42}};
    for (const auto& edge : edges) {
      LinearImage inside = sunAt(lens, edge.x, edge.y);
      vignetting.apply(&inside);
      const double mean = sumOf(inside) / 307200.0;
      // The last pixel's middle and the edge are half a pixel apart, 0.04 degrees: cos⁻³ differs by 0.2 %.
      EXPECT_NEAR(veil.meanOf(at(edge.right_deg, edge.up_deg)).value[1], mean, 0.006 * mean)
          << edge.x << " " << edge.y << " " << cos4;
    }
  }
}

TEST(VeilingGlare, OfALightOutsideFadesUpToTheHood) {
  const VeilingGlare veil = before(usual(), glare(0.01, 0.5, 50.0), true);
  // With cos⁴, E f²/N cos θ; the hood lets (50 − θ) / (50 − 30) of it pass, off by the half pixel at the
  // edge.
  for (const double angle_deg : {35.0, 40.0, 49.0}) {
    const double expected = 1e5 * std::cos(angle_deg * kRadPerDeg) * (50.0 - angle_deg) / 20.0;
    EXPECT_NEAR(veil.meanOf(at(angle_deg, 0.0)).value[1], expected, 0.005 * expected) << angle_deg;
  }
  EXPECT_EQ(veil.meanOf(at(50.1, 0.0)).value[1], 0.0F);
  EXPECT_EQ(veil.meanOf({-Eigen::Vector3d::UnitZ(), LinearRgb(1e5F, 1e5F, 1e5F)}).value[1], 0.0F);
  // Of every lens.
  for (const PublishedLens& published : publishedLenses()) {
    const VeilingGlare of_lens = before(published.lens(), glare(0.01, 0.5, 60.0));
    for (double angle_deg = 0.0; angle_deg < 180.0; angle_deg += 7.0) {
      const double angle = angle_deg * kRadPerDeg;
      const LinearRgb mean =
          of_lens.meanOf({{std::sin(angle), 0.0, std::cos(angle)}, LinearRgb(1.0F, 1.0F, 1.0F)});
      EXPECT_TRUE(mean.value[0] >= 0.0F && mean.value[0] < 20.0F) << published.name << " " << angle_deg;
    }
  }
}

// In steps of a tenth of a degree over 5 at least, by the cosine too: (2 / 5 per degree) / 10 at most.
TEST(VeilingGlare, FadesWithoutAStepAlsoWhereThePictureIsAsWideAsTheHoodOrWider) {
  std::vector<PublishedLens> lenses = publishedLenses();
  lenses.push_back({"130 degrees", PinholeCamera::fromFieldOfView(640, 480, Angle::degrees(130.0)), {}});
  for (const PublishedLens& published : lenses) {
    const VeilingGlare veil = before(published.lens(), glare(0.01, 0.5, 60.0));
    const auto meanOf = [&](double angle_deg) {
      const double angle = angle_deg * kRadPerDeg;
      const LightOutside light{{std::sin(angle), 0.0, std::cos(angle)}, LinearRgb(1.0F, 1.0F, 1.0F)};
      return static_cast<double>(veil.meanOf(light).value[0]);
    };
    constexpr double kFrom_deg = 20.0, kStep_deg = 0.1;
    const PinholeCamera& camera = published.camera;
    const Eigen::Vector3d edge = published.lens().unproject({camera.width - 1.0, camera.cy}).value();
    const double inside = meanOf(std::atan2(edge.x(), edge.z()) / kRadPerDeg);
    EXPECT_GT(inside, 0.0) << published.name;
    for (double angle_deg = kFrom_deg; angle_deg < 180.0; angle_deg += kStep_deg)
      EXPECT_LE(std::abs(meanOf(angle_deg + kStep_deg) - meanOf(angle_deg)), 0.045 * inside)
          << published.name << " " << angle_deg;
    EXPECT_EQ(meanOf(std::max(60.0, published.lens().widest().deg() + 5.0)), 0.0) << published.name;
  }
}

/// The veil of a light at the edge and of one just beyond it.
void expectLike(const LinearImage& inside, const LinearImage& outside) {
  for (int y = 20; y < 480; y += 40) {
    for (int x = 20; x < 640; x += 40) {
      const float seen = inside.at(x, y)[1];
      // By a Gaussian for five taps, which are a twentieth off, and the half pixel of the edge.
      EXPECT_NEAR(outside.at(x, y)[1], seen, 0.06F * seen) << x << " " << y;
    }
  }
}

TEST(VeilingGlare, LiesAboutTheEdgeThatALightHasPassed) {
  const Lens lens = usual();
  const VeilingGlare veil = before(lens, glare(0.05, 0.5));
  const struct {
    int x, y;
    double right_deg, up_deg;
  } edges[] = {{639, 240, 30.001, 0.0}, {320, 0, 0.0, 23.42}, {0, 0, -30.0, 23.42}};
  for (const auto& edge : edges) {
    LinearImage inside = sunAt(lens, edge.x, edge.y), outside = even(lens, 0.0F);
    veil.apply({}, &inside);
    veil.apply({at(edge.right_deg, edge.up_deg)}, &outside);
    SCOPED_TRACE(std::to_string(edge.x) + " " + std::to_string(edge.y));
    expectLike(inside, outside);
  }
  // Far beyond, 250 px, it is even but for what the widest Gaussian, of 146 px, has left there.
  LinearImage far = even(lens, 0.0F);
  veil.apply({at(58.0, 0.0)}, &far);
  EXPECT_NEAR(far.at(630, 240)[1] / far.at(10, 240)[1], 1.0, 0.1);
}

/// Its axis lies 160 px to the right of the picture.
Lens besideItsAxis() {
  return Lens({640, 480, 500.0, 500.0, 800.0, 239.5}, {});
}

/// That comes to lie there, or would.
LightOutside lightAt(const Lens& lens, double x, double y) {
  return {lens.unproject({x, y}).value().normalized(), LinearRgb(1e5F, 1e5F, 1e5F)};
}

TEST(VeilingGlare, LiesAboutTheNearestEdgeAlsoWhereTheAxisIsNotInThePicture) {
  const Lens lens = besideItsAxis();
  const VeilingGlare veil = before(lens, glare(0.05, 0.5));
  const struct {
    int x, y;
    double beyond_x, beyond_y;
  } edges[] = {
      {639, 240, 639.5, 240.0}, {0, 240, -0.5, 240.0}, {300, 0, 300.0, -0.5}, {639, 479, 639.5, 479.5}};
  for (const auto& edge : edges) {
    LinearImage inside = sunAt(lens, edge.x, edge.y), outside = even(lens, 0.0F);
    veil.apply({}, &inside);
    veil.apply({lightAt(lens, edge.beyond_x, edge.beyond_y)}, &outside);
    SCOPED_TRACE(std::to_string(edge.x) + " " + std::to_string(edge.y));
    expectLike(inside, outside);
  }
}

TEST(VeilingGlare, OfALightInThePictureThatNoPixelShowsLiesAboutIt) {
  for (const Lens& lens : {usual(), besideItsAxis()}) {
    const VeilingGlare veil = before(lens, glare(0.05, 0.5));
    for (const auto& [x, y] : {std::pair(310, 230), std::pair(120, 390)}) {
      LinearImage shown = sunAt(lens, x, y), not_shown = even(lens, 0.0F);
      veil.apply({}, &shown);
      veil.apply({lightAt(lens, x, y)}, &not_shown);
      expectLike(shown, not_shown);
    }
  }
}

TEST(VeilingGlare, FadesFromThatEdgeOnWithoutAStepOnBothSidesOfTheAxis) {
  const Lens lens = besideItsAxis();
  const VeilingGlare veil = before(lens, glare(0.05, 0.5));
  const double inside = sumOf(sunAt(lens, 639, 240)) / 307200.0;
  double brighter = veil.meanOf(lightAt(lens, 639.5, 240.0)).value[1];
  EXPECT_NEAR(brighter, inside, 0.006 * inside);  // half a pixel
  // Over the axis, up to 42.2 degrees from the edge, which is itself at 17.8: the hood is of 60. From pixel
  // to pixel, of 0.11 degrees at most, by 0.11 / 42 of it, and of the cosine's ratio.
  for (int x = 640; x < 1400; ++x) {
    const double mean = veil.meanOf(lightAt(lens, x, 240.0)).value[1];
    EXPECT_LE(mean, brighter) << x;
    EXPECT_LE(brighter - mean, 0.006 * inside) << x;
    brighter = mean;
  }
  EXPECT_EQ(brighter, 0.0);
}

TEST(VeilingGlare, OfALightOutsideLiesEvenlyAndInItsColour) {
  LinearImage picture = even(usual(), 100.0F);
  LightOutside lamp = at(31.0, 5.0);
  lamp.illuminance = LinearRgb(10.0F, 5.0F, 0.0F);
  const VeilingGlare veil = before(usual(), glare(0.02, 0.0));
  veil.apply({lamp, lamp}, &picture);
  const LinearRgb mean = veil.meanOf(lamp);
  for (const int x : {0, 300, 639})
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(picture.at(x, 20)[c], 100.0 + 0.02 * 2.0 * mean.value[c], 1e-3) << x << " " << c;
}

TEST(VeilingGlare, FallsWithTheSquareOfTheDistanceAroundALight) {
  LinearImage picture = even(usual(), 0.0F);
  for (int c = 0; c < 3; ++c) picture.at(320, 240)[c] = 1e9F;
  before(usual(), glare(0.02, 1.0)).apply({}, &picture);
  // Octaves of equal parts make 1 / r² between the narrowest and the widest; their steps show by a quarter.
  for (const int r : {8, 16, 32, 64})
    EXPECT_NEAR(picture.at(320 + r, 240)[1] / picture.at(320 + 2 * r, 240)[1], 4.0, 1.2) << r;
  // Round but for what comes in again at the edges.
  const float beside = picture.at(320 + 20, 240)[1];
  EXPECT_NEAR(picture.at(320, 240 + 20)[1] / beside, 1.0, 1e-3);
  EXPECT_NEAR(picture.at(320 - 20, 240)[1] / beside, 1.0, 1e-3);
  EXPECT_NEAR(picture.at(320 + 12, 240 + 16)[1] / beside, 1.0, 0.05);  // and what five taps are off by
}

TEST(VeilingGlare, HasTheSameBitsForAnyThreadCount) {
  const auto veiled = [] {
    LinearImage picture = sunAt(usual(), 100, 50);
    before(usual(), glare(0.02)).apply({at(31.0, 0.0)}, &picture);
    return picture.data;
  };
  const std::vector<float> parallel = veiled();
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(veiled(), parallel);
}

TEST(VeilingGlare, OfWhatIsNoNumberIsOne) {
  LinearImage picture = even(usual(), 100.0F);
  picture.data[3] = std::numeric_limits<float>::quiet_NaN();
  picture.data[6] = std::numeric_limits<float>::infinity();
  before(usual(), glare(0.02)).apply({}, &picture);
  for (const float value : picture.data) ASSERT_TRUE(std::isfinite(value));
}

TEST(GlareOptions, BadValuesAreNamedWithTheirRange) {
  const auto told = [](const GlareOptions& options) { return messageOf([&] { validate(options); }); };
  EXPECT_EQ(told({}), "");
  EXPECT_EQ(told(glare(0.3)), "share is 0.3, but must be from 0 to 0.2");
  EXPECT_EQ(told(glare(0.01, 1.5)), "wings is 1.5, but must be from 0 to 1");
  EXPECT_EQ(told(glare(0.01, 0.5, 91.0)), "hood is 91, but must be from 0 to 90 deg");
}

}  // namespace
}  // namespace sunlit::image
