// Rain in pictures by numbers on paper.
#include "sunlit/image/rain_streaks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "sunlit/quantity/frames.h"

namespace sunlit::image {
namespace {

constexpr int kWidth = 320, kHeight = 240;

/// Looks along x of `map`, left along y.
Eigen::Isometry3d level(const Eigen::Vector3d& eye) {
  return Eigen::Translation3d(eye) * linkFromOptical();
}

Lens pinhole() {
  return Lens(PinholeCamera::fromFieldOfView(kWidth, kHeight, Angle::degrees(60.0)), {});
}

Lens wideLens() {
  return Lens({kWidth, kHeight, 100.0, 100.0, 159.5, 119.5},
              {LensModel::kEquidistant, {0.01, -0.002, 0.0, 0.0}});
}

LinearImage grey(float luminance) {
  LinearImage picture(kWidth, kHeight);
  std::fill(picture.data.begin(), picture.data.end(), luminance);
  return picture;
}

DepthImage at(float depth_m) {
  DepthImage depth(kWidth, kHeight);
  std::fill(depth.data.begin(), depth.data.end(), depth_m);
  return depth;
}

/// Mean over `pictures` of the share of a white wall that rain takes away.
double taken(double mm_per_h, float wall_m, double exposure_s, int pictures) {
  const Lens lens = pinhole();
  const DepthImage depth = at(wall_m);
  double sum = 0.0;
  for (int i = 0; i < pictures; ++i) {
    RainStreaks rain{mm_per_h, 7, i, exposure_s};
    LinearImage picture = grey(1.0f);
    addRain(rain, {lens, level({3.2, -1.1, 1.0}), Motion(), depth}, &picture);
    for (const float value : picture.data) sum += 1.0 - static_cast<double>(value);
  }
  return sum / (3.0 * kWidth * kHeight * pictures);
}

/// ∫ over diameters above 1 mm of N(D) π/4 D², 1/m: what a metre of rain covers.
double shadowPerMetre(double mm_per_h) {
  const double slope = 4.1 * std::pow(mm_per_h, -0.21);
  double sum = 0.0;
  constexpr double kStep_mm = 0.001;
  for (double d = 1.0 + 0.5 * kStep_mm; d < 15.0; d += kStep_mm)
    sum += 8000.0 * std::exp(-slope * d) * 0.25 * kPi * d * d * 1e-6 * kStep_mm;
  return sum;
}

TEST(RainStreaks, TakeAwayWhatTheirShadowsCover) {
  for (const double mm_per_h : {10.0, 50.0}) {
    for (const double exposure_s : {0.0003, 0.005}) {
      // From 0.1 m on to the wall. A drop of 0.1 m distance is 3 px wide and there are few of them: 100
      // pictures leave some percent of chance.
      const double expected = 1.0 - std::exp(-shadowPerMetre(mm_per_h) * (4.0 - 0.1));
      EXPECT_NEAR(taken(mm_per_h, 4.0f, exposure_s, 100), expected, 0.12 * expected)
          << mm_per_h << " " << exposure_s;
    }
  }
}

TEST(RainStreaks, AreEvenAlongTheirWay) {
  // Upright, up to 9 px wide and some 200 px long. Where one lies on another, opacity rises or falls; strings
  // of beads would do both, a fifth of all pixels being the most or the least of their column's neighbours.
  const Lens lens(PinholeCamera::fromFieldOfView(kWidth, kHeight, Angle::degrees(6.0)), {});
  const DepthImage depth = at(12.0f);
  int covered = 0, beads = 0;
  for (int i = 0; i < 20; ++i) {
    LinearImage picture = grey(1.0f);
    addRain({50.0, 7, i, 0.01}, {lens, level({0.0, 0.0, 5.0}), Motion(), depth}, &picture);
    for (int x = 0; x < kWidth; ++x) {
      for (int y = 2; y < kHeight - 2; ++y) {
        const float here = *picture.at(x, y), above = *picture.at(x, y - 2), below = *picture.at(x, y + 2);
        covered += here < 0.98f ? 1 : 0;
        const float least = std::min(above, below), most = std::max(above, below);
        beads += here < least - 0.001f || here > most + 0.001f ? 1 : 0;
      }
    }
  }
  ASSERT_GT(covered, 100000);
  EXPECT_LT(beads, 0.02 * covered);
}

TEST(RainStreaks, AreNoneBeforeWhatIsNearerOrWithoutRain) {
  EXPECT_EQ(taken(50.0, 0.05f, 0.001, 2), 0.0);
  EXPECT_EQ(taken(0.0, 4.0f, 0.001, 2), 0.0);
}

TEST(RainStreaks, AreNoneUnderARoof) {
  const Lens lens = pinhole();
  const DepthImage wall = at(4.0f);
  const auto picture = [&](const std::function<bool(const Eigen::Vector3d&)>& open) {
    LinearImage rained = grey(1.0f);
    addRain({50.0, 7, 1, 0.001}, {lens, level({0.0, 0.0, 1.0}), Motion(), wall, open}, &rained);
    return rained.data;
  };
  EXPECT_EQ(picture([](const Eigen::Vector3d&) { return false; }), grey(1.0f).data);
  EXPECT_EQ(picture([](const Eigen::Vector3d&) { return true; }), picture({}));
  // A roof over the left half of what is seen, which looks along x: y > 0.
  const std::vector<float> half = picture([](const Eigen::Vector3d& place) { return place.y() < 0.0; });
  double left = 0.0, right = 0.0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      // Drops near the middle reach over it by their width.
      const double lost = 1.0 - static_cast<double>(half[3 * static_cast<std::size_t>(y * kWidth + x)]);
      (x < kWidth / 2 - 10 ? left : right) += lost;
    }
  }
  EXPECT_EQ(left, 0.0);
  EXPECT_GT(right, 10.0);
}

TEST(RainStreaks, OfOneMomentAreTheSameAgainAndOfAnotherOthers) {
  const Lens lens = pinhole();
  const DepthImage sky = at(std::numeric_limits<float>::quiet_NaN());
  const auto pictureOf = [&](std::uint64_t seed, std::int64_t moment, const std::string& drive = "") {
    RainStreaks rain{30.0, seed, moment, 0.002};
    rain.drive = drive;
    LinearImage picture = grey(1.0f);
    addRain(rain, {lens, level({0.0, 0.0, 1.0}), Motion(), sky}, &picture);
    return picture.data;
  };
  EXPECT_EQ(pictureOf(1, 5), pictureOf(1, 5));
  EXPECT_NE(pictureOf(1, 5), pictureOf(1, 6));
  EXPECT_NE(pictureOf(1, 5), pictureOf(2, 5));
  EXPECT_NE(pictureOf(1, 5), pictureOf(1, 5, "beside"));
  EXPECT_EQ(pictureOf(1, 5, "beside"), pictureOf(1, 5, "beside"));
}

/// What is brighter than black, in the mean: how much, where, and how wide.
struct Blot {
  double sum = 0.0;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero(), variance = Eigen::Vector2d::Zero();
};
Blot blotIn(const LinearImage& picture) {
  Blot blot;
  Eigen::Vector2d squares = Eigen::Vector2d::Zero();
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const double value = static_cast<double>(picture.at(x, y)[0]);
      const Eigen::Vector2d at(x, y);
      blot.sum += value;
      blot.middle += value * at;
      squares += value * at.cwiseProduct(at);
    }
  }
  blot.middle /= blot.sum;
  blot.variance = squares / blot.sum - blot.middle.cwiseProduct(blot.middle);
  return blot;
}

/// So little rain that most pictures have no drop, and hardly any two.
Blot drizzled(std::int64_t index, const Lens& lens, const Eigen::Vector3d& eye, const Motion& motion = {}) {
  LinearImage picture(kWidth, kHeight);
  const DepthImage sky = at(std::numeric_limits<float>::quiet_NaN());
  RainStreaks rain{0.02, 3, index, motion.none() ? 1e-6 : 0.0003};
  rain.luminance.setOnes();
  addRain(rain, {lens, level(eye), motion, sky}, &picture);
  return blotIn(picture);
}

/// Whether there is one drop, which the picture has all of.
bool isDot(const Blot& blot) {
  return blot.sum > 0.0 && blot.variance.maxCoeff() < 1.0 && blot.middle.x() > 5.0 && blot.middle.y() > 5.0 &&
         blot.middle.x() < kWidth - 6.0 && blot.middle.y() < kHeight - 6.0;
}

// Three cameras 2 cm apart: from one to the next a drop moves by f B / z, level, and twice that to the third.
// Its place is then known, and a fisheye has it where its formula says.
TEST(RainStreaks, ArePlacesInSpaceForEveryCamera) {
  const Lens lens = pinhole();
  const Lens fisheye = wideLens();
  int dots = 0;
  for (std::int64_t i = 0; i < 400; ++i) {
    const Blot left = drizzled(i, lens, {0.0, 0.02, 1.0});
    const Blot middle = drizzled(i, lens, {0.0, 0.0, 1.0});
    const Blot right = drizzled(i, lens, {0.0, -0.02, 1.0});
    if (!isDot(left) || !isDot(middle) || !isDot(right)) continue;
    ++dots;
    const double moved = left.middle.x() - middle.middle.x();
    EXPECT_NEAR(middle.middle.x() - right.middle.x(), moved, 0.01) << i;
    EXPECT_NEAR(left.middle.y(), middle.middle.y(), 0.01) << i;
    const double z = lens.camera().fx * 0.02 / moved;
    EXPECT_GT(z, 0.05) << i;
    EXPECT_LT(z, 5.3) << i;  // of the last, moved by 1 px, 0.01 px are 1 %
    const Blot bent = drizzled(i, fisheye, {0.0, 0.0, 1.0});
    if (!isDot(bent)) continue;  // of another drop, too
    const Eigen::Vector2d expected = fisheye.project(z * lens.unproject(middle.middle).value()).value();
    EXPECT_LT((bent.middle - expected).norm(), 0.05) << i;
  }
  EXPECT_GT(dots, 20);
}

// Beside a camera's 300 m/s what drops fall by, 3 % of that, is little: they pass as level streaks, or as
// steep ones. In one picture of ten another drop comes in meanwhile.
TEST(RainStreaks, SlantAsTheCameraMoves) {
  const Lens lens = pinhole();
  int streaks = 0, level = 0, steep = 0;
  for (std::int64_t i = 0; i < 400; ++i) {
    if (!isDot(drizzled(i, lens, {0.0, 0.0, 1.0}))) continue;
    ++streaks;
    const Blot across = drizzled(i, lens, {0.0, 0.0, 1.0}, {{0.0, -300.0, 0.0}, Eigen::Vector3d::Zero()});
    const Blot down = drizzled(i, lens, {0.0, 0.0, 1.0}, {{0.0, 0.0, -300.0}, Eigen::Vector3d::Zero()});
    level += across.variance.x() > 10.0 * across.variance.y() ? 1 : 0;
    steep += down.variance.y() > 10.0 * down.variance.x() ? 1 : 0;
  }
  EXPECT_GT(streaks, 20);
  EXPECT_GT(level, 0.8 * streaks);
  EXPECT_GT(steep, 0.8 * streaks);
}

TEST(RainStreaks, GoWithTheWindAsPastACameraThatGoesAgainstIt) {
  const Lens lens = pinhole();
  const DepthImage sky = at(std::numeric_limits<float>::quiet_NaN());
  const auto picture = [&](const Eigen::Vector2d& wind_m_s, const Motion& motion) {
    LinearImage rained = grey(1.0f);
    RainStreaks rain{30.0, 5, 1, 0.01};
    rain.wind_m_s = wind_m_s;
    addRain(rain, {lens, level({0.0, 0.0, 1.0}), motion, sky}, &rained);
    return rained.data;
  };
  const std::vector<float> blown = picture({4.0, -7.0}, {});
  EXPECT_EQ(blown, picture({0.0, 0.0}, {{-4.0, 7.0, 0.0}, Eigen::Vector3d::Zero()}));
  EXPECT_NE(blown, picture({0.0, 0.0}, {}));
}

TEST(RainStreaks, ShineByWhatTheySeeWhateverTheSunsDiscTakesOfThePicture) {
  const Eigen::Array3f lux(1e5f, 9e4f, 8e4f);
  LinearImage picture = grey(1000.0f);
  const auto shown = [&] { return dropLuminance(picture, lux); };
  const Eigen::Array3f without = 0.5f * (1000.0f + lux / kPiFloat);
  EXPECT_LT((shown() / without - 1.0f).abs().maxCoeff(), 1e-6f);
  // Of 0.53° before a camera of 60° the disc has 5 px across, before one of 12° 25: seven and 300 lx / π.
  for (const int across_px : {5, 25}) {
    for (int y = 0; y < across_px; ++y)
      for (int x = 0; x < across_px; ++x) std::fill_n(picture.at(x, y), 3, 1.6e9f);
    EXPECT_TRUE((shown() >= without).all());
    EXPECT_TRUE((shown() < 1.1f * without).all()) << shown().transpose();
  }
  // By night lamps light what drops see.
  picture = grey(2.0f);
  EXPECT_NEAR(dropLuminance(picture, Eigen::Array3f::Constant(1e-3f))[0], 1.0f, 1e-3f);
}

/// All places of drops of a moment, in `map`.
std::vector<Eigen::Vector3d> placesOf(const RainStreaks& rain, const Lens& lens, const Motion& motion) {
  std::vector<Eigen::Vector3d> places;
  LinearImage picture(kWidth, kHeight);
  const DepthImage sky = at(std::numeric_limits<float>::quiet_NaN());
  const auto note = [&](const Eigen::Vector3d& place) {
    places.push_back(place);
    return false;
  };
  addRain(rain, {lens, level(Eigen::Vector3d::Zero()), motion, sky, note}, &picture);
  return places;
}

/// That drop alone, on black.
Blot alone(const Eigen::Vector3d& drop, const RainStreaks& rain, const Lens& lens, const Motion& motion) {
  LinearImage picture(kWidth, kHeight);
  const DepthImage sky = at(std::numeric_limits<float>::quiet_NaN());
  addRain(rain,
          {lens, level(Eigen::Vector3d::Zero()), motion, sky,
           [&](const Eigen::Vector3d& place) { return place == drop; }},
          &picture);
  return blotIn(picture);
}

/// What a drop of `diameter_m` leaves of itself from moment to moment: the mean of a thousand.
std::optional<Blot> onPaper(const Eigen::Vector3d& middle, const Eigen::Vector3d& half, double diameter_m,
                            const Lens& lens) {
  Blot blot;
  constexpr int kMoments = 1000;
  constexpr double kWithin_px = 8.0;
  Eigen::Vector2d squares = Eigen::Vector2d::Zero();
  for (int i = 0; i < kMoments; ++i) {
    const Eigen::Vector3d place = middle + (2.0 * (i + 0.5) / kMoments - 1.0) * half;
    const std::optional<Eigen::Vector2d> pixel = lens.project(place);
    if (!pixel || pixel->minCoeff() < kWithin_px || pixel->x() > kWidth - kWithin_px ||
        pixel->y() > kHeight - kWithin_px)
      return std::nullopt;
    const double across_px = diameter_m * lens.camera().fx / (lens.wide() ? place.norm() : place.z());
    const double area = 0.25 * kPi * across_px * across_px / kMoments;
    blot.sum += area;
    blot.middle += area * *pixel;
    squares += area * pixel->cwiseProduct(*pixel);
  }
  blot.middle /= blot.sum;
  blot.variance = squares / blot.sum - blot.middle.cwiseProduct(blot.middle);
  return blot;
}

// A car drives 10 m/s for 1/30 s, a third of a metre: what it passes grows, and runs the faster the nearer it
// is. What a drop takes is faint, so that it hardly takes from itself.
TEST(RainStreaks, GrowAndBendAsTheCameraDrivesPast) {
  const Motion drives{{10.0, 0.0, 0.0}, {0.0, 0.0, 0.3}};
  for (const Lens& lens : {pinhole(), wideLens()}) {
    RainStreaks rain{3.0, 7, 1, 1.0 / 30.0};
    rain.luminance.setOnes();
    RainStreaks frozen = rain;
    frozen.exposure_s = 1e-7;
    int streaks = 0;
    for (const Eigen::Vector3d& place : placesOf(rain, lens, drives)) {
      const Eigen::Vector3d middle(-place.y(), -place.z(), place.x());
      if (place.x() < 0.3 || place.norm() > 1.5) continue;
      // A drop of 1 mm is 3 px wide 0.1 m before the pinhole: its area tells its diameter, within a percent.
      const double depth_m = lens.wide() ? middle.norm() : middle.z();
      const double area = alone(place, frozen, lens, {}).sum;
      const double diameter_m = std::sqrt(area / (0.25 * kPi)) * depth_m / lens.camera().fx;
      const double falls_m_s = 9.65 - 10.3 * std::exp(-600.0 * diameter_m);
      const Eigen::Vector3d past =
          Eigen::Vector3d(0.0, 0.0, -falls_m_s) - drives.velocity_m_s - drives.turning_rad_s.cross(place);
      const Eigen::Vector3d half = 0.5 * rain.exposure_s * Eigen::Vector3d(-past.y(), -past.z(), past.x());
      const std::optional<Blot> expected = onPaper(middle, half, diameter_m, lens);
      if (!expected) continue;
      ++streaks;
      const Blot drawn = alone(place, rain, lens, drives);
      EXPECT_NEAR(drawn.sum, expected->sum, 0.03 * expected->sum) << place.transpose();
      EXPECT_LT((drawn.middle - expected->middle).norm(), 0.3) << place.transpose();
      // And a drop's own width, squared.
      for (int i = 0; i < 2; ++i) {
        const double wider = drawn.variance[i] - expected->variance[i];
        EXPECT_GT(wider, -0.02 * expected->variance[i]) << place.transpose();
        EXPECT_LT(wider, 4.0 + 0.02 * expected->variance[i]) << place.transpose();
      }
    }
    EXPECT_GT(streaks, 10) << nameOf(lens.distortion().model);
  }
}

TEST(RainStreaks, ShowDropsUntilTheCameraHasPassedThem) {
  // 0.15 m ahead at the middle of the exposure, in whose second half the camera drives 0.17 m.
  const Motion drives{{10.0, 0.0, 0.0}, Eigen::Vector3d::Zero()};
  RainStreaks rain{100.0, 7, 0, 1.0 / 30.0};
  rain.luminance.setOnes();
  int passed = 0;
  for (; rain.moment < 60; ++rain.moment) {
    for (const Eigen::Vector3d& place : placesOf(rain, pinhole(), drives)) {
      if (place.x() < 0.12 || place.x() > 0.16 || std::hypot(place.y(), place.z()) > 0.03) continue;
      ++passed;
      EXPECT_GT(alone(place, rain, pinhole(), drives).sum, 0.5) << place.transpose();
    }
  }
  EXPECT_GT(passed, 5);
}

TEST(RainStreaks, AreAsManyAsTheirDistributionHas) {
  // 8000 / Λ e^−Λ of more than 1 mm in a cubic metre, Λ = 4.1 /mm at 1 mm/h: 32.3. In a pyramid before the
  // camera, of 0.8 x² m² across.
  constexpr int kMoments = 400;
  constexpr double kFrom_m = 1.0, kTo_m = 4.0;
  double count = 0.0;
  for (int i = 0; i < kMoments; ++i) {
    for (const Eigen::Vector3d& place : placesOf({1.0, 7, i, 1e-6}, pinhole(), {})) {
      const bool is_between = place.x() > kFrom_m && place.x() < kTo_m;
      const bool is_beside = std::abs(place.y()) > 0.5 * place.x() || std::abs(place.z()) > 0.4 * place.x();
      count += is_between && !is_beside ? 1.0 : 0.0;
    }
  }
  const double volume_m3 = 0.8 * (std::pow(kTo_m, 3) - std::pow(kFrom_m, 3)) / 3.0;
  const double expected = 8000.0 / 4.1 * std::exp(-4.1) * volume_m3 * kMoments;
  // Three standard deviations of 217,000. Half a drop more a cell were 1.5 %.
  EXPECT_NEAR(count, expected, 3.0 * std::sqrt(expected));
}

}  // namespace
}  // namespace sunlit::image
