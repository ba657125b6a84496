// Moon and stars through a camera's pixels.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "light/picture/sky/disc_in_view.h"
#include "light/picture/sky/sky_pixel.h"
#include "light/picture/sky/star_field.h"
#include "sunlit/quantity/angle.h"
#include "support/usual_air.h"

namespace sunlit::light {
namespace {

/// A camera that looks `towards`, turned by fractions of a pixel; all pixels see the sky.
Surfaces cameraTowards(const Eigen::Vector3d& towards, double fov_deg,
                       const Eigen::Vector2d& shift_px = {0, 0}) {
  constexpr int kSize = 64;
  Surfaces surfaces;
  surfaces.width = surfaces.height = kSize;
  surfaces.samples_per_pixel = 4;
  const double pixel = 2.0 * std::tan(0.5 * fov_deg * kRadPerDeg) / kSize;
  const Eigen::Vector3d right = towards.cross(Eigen::Vector3d::UnitZ()).normalized() * pixel;
  const Eigen::Vector3d down = towards.cross(right).normalized() * pixel;
  surfaces.pixel_right = right.cast<float>();
  surfaces.pixel_down = down.cast<float>();
  const double middle = 0.5 * (kSize - 1);
  surfaces.pixel_origin =
      (towards.normalized() - (middle + shift_px.x()) * right - (middle + shift_px.y()) * down).cast<float>();
  for (int i = 0; i < 16; ++i) {
    Tile tile;
    tile.x = i % 4 * Surfaces::kTileSize;
    tile.y = i / 4 * Surfaces::kTileSize;
    tile.width = tile.height = Surfaces::kTileSize;
    tile.sky.assign(256, 4);
    surfaces.tiles.push_back(tile);
  }
  return surfaces;
}

/// Solid angle of a pixel, sr.
double solidAngle(const Surfaces& s, int x, int y) {
  const Eigen::Vector3f ray =
      s.pixel_origin + static_cast<float>(x) * s.pixel_right + static_cast<float>(y) * s.pixel_down;
  return static_cast<double>(s.pixel_right.cross(s.pixel_down).norm()) / std::pow(ray.norm(), 3);
}

/// Illuminance, lx, of all that the disc's pixels show.
double received(const Surfaces& surfaces, const DiscInView& disc) {
  double sum = 0.0;
  for (int y = 0; y < surfaces.height; ++y) {
    for (int x = 0; x < surfaces.width; ++x) {
      const Eigen::Vector3f towards = surfaces.pixel_origin + static_cast<float>(x) * surfaces.pixel_right +
                                      static_cast<float>(y) * surfaces.pixel_down;
      if (disc.near(towards.normalized()))
        sum += LinearRgb(disc.luminance(x, y)).luminance() * solidAngle(surfaces, x, y);
    }
  }
  return sum;
}

/// A moon of 1 lx at 30° of elevation in the north, lit by a sun that stands `phase_deg` at the moon from the
/// observer, towards the east.
sky::DiscLight moonOfPhase(double phase_deg, double elevation_deg = 30.0) {
  sky::DiscLight moon;
  moon.towards = Direction(Azimuth::degrees(0.0), Angle::degrees(elevation_deg));
  moon.angular_radius = Angle::degrees(0.26);
  moon.illuminance = LinearRgb(1.0f, 1.0f, 1.0f);
  const double phase = phase_deg * kRadPerDeg;
  moon.lit_from =
      Direction(-std::cos(phase) * moon.towards.vector() + std::sin(phase) * Eigen::Vector3d::UnitX());
  return moon;
}

/// A sun of 1 lx at 30° of elevation in the north, of which a moon covers some from above.
sky::DiscLight sunCovered(double apart_deg, double cover_deg) {
  sky::DiscLight sun;
  sun.towards = Direction(Azimuth::degrees(0.0), Angle::degrees(30.0));
  sun.illuminance = LinearRgb(1.0f, 1.0f, 1.0f);
  sun.cover = sky::DiscCover{Direction(Azimuth::degrees(0.0), Angle::degrees(30.0 + apart_deg)),
                             Angle::degrees(cover_deg)};
  return sun;
}

TEST(CoveredSun, ShinesAsMuchAsItsIlluminanceWhateverIsLeft) {
  for (const double apart_deg : {0.0, 0.03, 0.1, 0.3, 0.5}) {
    for (const double cover_deg : {0.25, 0.28}) {
      if (apart_deg + 0.2666 < cover_deg) continue;  // total
      for (const double fov_deg : {1.0, 10.0}) {
        const sky::DiscLight sun = sunCovered(apart_deg, cover_deg);
        const Surfaces camera = cameraTowards(sun.towards.vector(), fov_deg);
        // As of thin crescents of the moon.
        EXPECT_NEAR(received(camera, DiscInView(camera, sun)), 1.0, 0.05)
            << apart_deg << " " << cover_deg << " " << fov_deg;
      }
    }
  }
}

TEST(CoveredSun, IsDarkWhereTheMoonIs) {
  const sky::DiscLight sun = sunCovered(0.15, 0.26);
  const Surfaces camera = cameraTowards(sun.towards.vector(), 1.0);  // 64 px to a degree
  const DiscInView disc(camera, sun);
  const int above = 32 - 10, below = 32 + 14;
  EXPECT_EQ(LinearRgb(disc.luminance(32, above)).luminance(), 0.0f);
  EXPECT_GT(LinearRgb(disc.luminance(32, below)).luminance(), 0.0f);
}

TEST(Moon, ShinesAsMuchAsItsIlluminanceAtEveryPhaseAndSize) {
  for (const double phase_deg : {0.0, 40.0, 90.0, 140.0, 165.0}) {
    for (const double fov_deg : {60.0, 20.0, 2.0}) {  // a radius of 0.3, 0.8 and 8 pixels
      for (const Eigen::Vector2d& shift : {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(0.3, 0.45)}) {
        const sky::DiscLight moon = moonOfPhase(phase_deg);
        const Surfaces camera = cameraTowards(moon.towards.vector(), fov_deg, shift);
        // 32 points across the radius, and 16 across the crescent at 140°; but 4 at 165°,
        // where it is 1/29 of the radius wide.
        EXPECT_NEAR(received(camera, DiscInView(camera, moon)), 1.0, phase_deg > 150.0 ? 0.05 : 0.015)
            << "phase " << phase_deg << ", field of view " << fov_deg;
      }
    }
  }
}

TEST(Moon, TakesNoMoreWorkInAWideViewAndShinesAsMuch) {
  // A pinhole of 170°: pixels are 2° wide in its middle, 0.06° by 0.4° where the moon is last.
  for (const double aside_deg : {0.0, 50.0, 80.0}) {
    const sky::DiscLight moon = moonOfPhase(40.0);
    const Eigen::Vector3d towards = moon.towards.vector(), east = Eigen::Vector3d::UnitX();
    const double aside = aside_deg * kRadPerDeg;
    Surfaces camera = cameraTowards(std::cos(aside) * towards + std::sin(aside) * east, 170.0);
    constexpr int kWidth = 640, kHeight = 400;
    const float finer = static_cast<float>(camera.width) / kWidth;
    const Eigen::Vector3f middle = camera.pixel_origin + 31.5f * (camera.pixel_right + camera.pixel_down);
    camera.width = kWidth;
    camera.height = kHeight;
    camera.pixel_right *= finer;
    camera.pixel_down *= finer;
    camera.pixel_origin =
        middle - 0.5f * (kWidth - 1) * camera.pixel_right - 0.5f * (kHeight - 1) * camera.pixel_down;
    const DiscInView disc(camera, moon);
    // Solid angles differ by 2 % within a pixel at 80°.
    EXPECT_NEAR(received(camera, disc), 1.0, 0.02) << aside_deg;
    int points = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) points += disc.points(x, y);
    // At most four pixels of 256 points an axis; elsewhere 32 points to the radius fill its square by 4096,
    // or pixels of at least 4 points an axis.
    EXPECT_LE(points, 4 * 256 * 256) << aside_deg;
    EXPECT_GE(points, 64 * 64 / 2) << aside_deg;
  }
}

TEST(Moon, KeepsItsIlluminanceWhileItSets) {
  // `illuminance` is what the part above the horizon gives; the rest of the disc is not shown.
  for (const double elevation_deg : {0.2, 0.0, -0.15}) {
    const sky::DiscLight moon = moonOfPhase(0.0, elevation_deg);
    const Surfaces camera = cameraTowards(moon.towards.vector(), 2.0);
    // 13 rows of points are above the horizon where least of the disc is.
    EXPECT_NEAR(received(camera, DiscInView(camera, moon)), 1.0, 0.025) << elevation_deg;
  }
}

TEST(Moon, ShowsItsLitSideTowardsTheSun) {
  const sky::DiscLight moon = moonOfPhase(90.0);
  const Surfaces camera = cameraTowards(moon.towards.vector(), 2.0);
  const DiscInView disc(camera, moon);
  double east = 0.0, west = 0.0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 32; ++x) {  // looking north, east is to the right
      west += disc.luminance(x, y)[1];
      east += disc.luminance(63 - x, y)[1];
    }
  }
  EXPECT_GT(east, 0.0);
  EXPECT_LT(west, 1e-3 * east);  // the terminator runs along the boundary of two pixels
}

TEST(Moon, AtFullIsEvenlyBright) {
  const sky::DiscLight moon = moonOfPhase(0.0);
  const Surfaces camera = cameraTowards(moon.towards.vector(), 2.0);
  const DiscInView disc(camera, moon);
  // E / (π r²): within 1e-4 of the exact solid angle. Single precision makes 0.3 % of the radius.
  const double expected = 1.0 / (kPi * std::pow(0.26 * kRadPerDeg, 2));
  EXPECT_NEAR(disc.luminance(32, 32)[1], expected, 0.01 * expected);
  EXPECT_NEAR(disc.luminance(32 + 6, 32)[1], expected, 0.01 * expected);
}

TEST(Moon, ThatIsNewOrSetIsNotShown) {
  sky::DiscLight moon = moonOfPhase(180.0);
  Surfaces camera = cameraTowards(moon.towards.vector(), 2.0);
  EXPECT_FALSE(DiscInView(camera, moon).near(moon.towards.vector().cast<float>()));
  moon = moonOfPhase(0.0, -0.5);
  camera = cameraTowards(moon.towards.vector(), 2.0);
  EXPECT_FALSE(DiscInView(camera, moon).near(moon.towards.vector().cast<float>()));
}

/// A night, or any hour, with one star high in the north, and, if asked for, the full moon before it.
sky::Daylight skyWithStar(double sun_elevation_deg, bool behind_moon = false) {
  auto stars = std::make_shared<std::vector<sky::Star>>();
  stars->push_back({Eigen::Vector3f(0.0f, 0.5f, std::sqrt(0.75f)), sky::starIlluminance(3.0, 0.6)});
  sky::NightSky night;
  night.stars = stars;
  night.map_from_celestial = Eigen::Matrix3d::Identity();
  if (behind_moon) {
    night.moon.emplace();
    night.moon->apparent = Direction(Eigen::Vector3d(0.0, 0.5, std::sqrt(0.75)));
  }
  return sky::usualAir().daylight(
      {Direction(Azimuth::degrees(180.0), Angle::degrees(sun_elevation_deg)), 1.0}, night);
}

/// What all spots of all tiles give, lx, and the brightest pixel, cd/m².
struct Shown {
  double illuminance = 0.0;
  double brightest = 0.0;
};

Shown shown(const Surfaces& surfaces, const sky::Daylight& day) {
  const StarField field(surfaces, day, DiscInView(surfaces, day.moon()));
  Shown sum;
  for (const Tile& tile : surfaces.tiles) {
    for (const StarField::Spot& spot : field.in(tile)) {
      EXPECT_TRUE(spot.x >= tile.x && spot.x < tile.x + 16 && spot.y >= tile.y && spot.y < tile.y + 16);
      const double luminance = LinearRgb(spot.luminance).luminance();
      sum.illuminance += luminance * solidAngle(surfaces, spot.x, spot.y);
      sum.brightest = std::max(sum.brightest, luminance);
    }
  }
  return sum;
}

TEST(Stars, AreHiddenByTheCloudsBeforeThem) {
  auto stars = std::make_shared<std::vector<sky::Star>>();
  stars->push_back({Eigen::Vector3f(0.0f, 0.5f, std::sqrt(0.75f)), sky::starIlluminance(3.0, 0.6)});
  sky::NightSky night;
  night.stars = stars;
  night.map_from_celestial = Eigen::Matrix3d::Identity();
  sky::Weather weather;
  weather.cover_oktas = 4.0;
  const sky::Daylight day = sky::usualAir().daylight(
      {Direction(Azimuth::degrees(180.0), Angle::degrees(-30.0)), 1.0}, night, weather);
  ASSERT_EQ(day.stars().size(), 1u);
  const Eigen::Vector3f& towards = day.stars()[0].towards;
  std::vector<float> shares;
  for (float x = 0.0f; x < 6000.0f; x += 400.0f) {
    Surfaces surfaces = cameraTowards(towards.cast<double>(), 20.0);
    surfaces.eye = Eigen::Vector3f(x, 0.0f, 0.0f);
    const double alone = day.stars()[0].illuminance.luminance();
    const float share =
        day.seenFrom(surfaces.eye).starSeen(day.stars()[0]).luminance() / static_cast<float>(alone);
    shares.push_back(share);
    EXPECT_NEAR(shown(surfaces, day).illuminance, alone * static_cast<double>(share), 0.02 * alone) << x;
  }
  EXPECT_LT(*std::min_element(shares.begin(), shares.end()), 0.3f);
  EXPECT_GT(*std::max_element(shares.begin(), shares.end()), 1.3f);
}

TEST(Stars, DoNotTwinkleAsTheCameraTurnsByPartsOfAPixel) {
  const sky::Daylight day = skyWithStar(-30.0);
  ASSERT_EQ(day.stars().size(), 1u);
  const double expected = day.stars()[0].illuminance.luminance();
  const Eigen::Vector3d towards = day.stars()[0].towards.cast<double>();
  double least_peak = 1e9, most_peak = 0.0;
  for (double du = 0.0; du < 1.0; du += 0.125) {
    for (double dv = 0.0; dv < 1.0; dv += 0.125) {
      const Shown sum = shown(cameraTowards(towards, 20.0, {du + 3.0, dv - 11.0}), day);
      // Pixels are 1e-3 different in size across the spline.
      ASSERT_NEAR(sum.illuminance, expected, 0.002 * expected) << du << ' ' << dv;
      least_peak = std::min(least_peak, sum.brightest);
      most_peak = std::max(most_peak, sum.brightest);
    }
  }
  // Between (2/3)² at a pixel's centre and (23/48)² at its corner.
  EXPECT_LT(most_peak / least_peak, 1.95);
}

TEST(Stars, AreWhereTheyStand) {
  const sky::Daylight day = skyWithStar(-30.0);
  const Surfaces camera = cameraTowards(day.stars()[0].towards.cast<double>(), 20.0, {10.25, -7.5});
  const StarField field(camera, day, DiscInView(camera, day.moon()));
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double weight = 0.0;
  for (const Tile& tile : camera.tiles) {
    for (const StarField::Spot& spot : field.in(tile)) {
      centre += spot.luminance[1] * Eigen::Vector2d(spot.x, spot.y);
      weight += spot.luminance[1];
    }
  }
  // The camera was shifted the other way. Single precision: 1e-7 of a direction is 2e-5 pixels of 0.3°.
  EXPECT_NEAR(centre.x() / weight, 31.5 + 10.25, 1e-3);
  EXPECT_NEAR(centre.y() / weight, 31.5 - 7.5, 1e-3);
}

// r = f θ: a fisheye of 22 px to the radian has what stands 100° from its axis 38.4 px from the middle,
// towards a corner. Pixels are 2.6° wide, so that those of a spline differ in solid angle by a hundredth or
// two.
TEST(Stars, StandWhereAFisheyeHasThemAlsoBehindIt) {
  const sky::Daylight day = skyWithStar(-30.0);
  const Eigen::Vector3d star = day.stars().at(0).towards.cast<double>();
  const image::Lens fisheye({64, 64, 22.0, 22.0, 31.5, 31.5}, {image::LensModel::kEquidistant, {0, 0, 0, 0}});
  const auto rays = std::make_shared<const PixelRays>(fisheye);
  for (const double deg : {0.0, 50.0, 88.0, 100.0}) {
    Surfaces camera = cameraTowards(Eigen::Vector3d::UnitX(), 20.0);
    // In the optical frame the star lies to the lower right, so far from the axis.
    const double angle = deg * kRadPerDeg, part = std::sin(angle) * std::sqrt(0.5);
    camera.map_from_optical =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d(part, part, std::cos(angle)), star)
            .toRotationMatrix();
    camera.bent = rays;
    const StarField field(camera, day, DiscInView(camera, day.moon()));
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    double weight = 0.0, illuminance = 0.0;
    for (const Tile& tile : camera.tiles) {
      for (const StarField::Spot& spot : field.in(tile)) {
        centre += spot.luminance[1] * Eigen::Vector2d(spot.x, spot.y);
        weight += spot.luminance[1];
        const Eigen::Vector3d right = rays->right(spot.x, spot.y), below = rays->down(spot.x, spot.y);
        illuminance += LinearRgb(spot.luminance).luminance() * right.cross(below).norm();
      }
    }
    ASSERT_GT(weight, 0.0) << deg;
    const double expected = 31.5 + 22.0 * angle * std::sqrt(0.5);
    EXPECT_NEAR(centre.x() / weight, expected, 1e-3) << deg;
    EXPECT_NEAR(centre.y() / weight, expected, 1e-3) << deg;
    EXPECT_NEAR(illuminance / day.stars()[0].illuminance.luminance(), 1.0, 0.02) << deg;
  }
}

TEST(Stars, AreNotSeenByDayNorBehindTheMoonNorBehindTheCamera) {
  const Eigen::Vector3d towards = skyWithStar(-30.0).stars().at(0).towards.cast<double>();
  const Surfaces camera = cameraTowards(towards, 20.0);
  EXPECT_GT(shown(camera, skyWithStar(-30.0)).illuminance, 0.0);
  EXPECT_EQ(shown(camera, skyWithStar(40.0)).illuminance, 0.0);
  EXPECT_EQ(shown(camera, skyWithStar(-30.0, true)).illuminance, 0.0);
  EXPECT_EQ(shown(cameraTowards(-towards, 20.0), skyWithStar(-30.0)).illuminance, 0.0);
}

TEST(Stars, AreHiddenByTheSharesOfPixelsThatSurfacesFill) {
  const sky::Daylight day = skyWithStar(-30.0);
  Surfaces camera = cameraTowards(day.stars().at(0).towards.cast<double>(), 20.0);
  const SkyPixel sky(camera, day);
  const auto brightest = [&](std::uint8_t samples) {
    image::LinearImage image(64, 64);
    for (Tile& tile : camera.tiles) {
      tile.sky.assign(256, samples);
      sky.addTo(tile, &image);
    }
    return static_cast<double>(*std::max_element(image.data.begin(), image.data.end()));
  };
  const double open = brightest(4);
  EXPECT_GT(open, 2.0 * LinearRgb(sky.luminance(0, 0)).luminance());
  EXPECT_NEAR(brightest(1), 0.25 * open, 1e-6 * open);  // rounding
  EXPECT_EQ(brightest(0), 0.0);
}

}  // namespace
}  // namespace sunlit::light
