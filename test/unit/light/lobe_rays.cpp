// Rays of a surface's lobe against the lobe itself.
#include "light/picture/mirror/lobe_rays.h"

#include <gtest/gtest.h>

#include <cmath>

#include "light/picture/mirror/shared_lobes.h"
#include "light/shading/shading.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

constexpr int kWidth = 160;                       ///< px
constexpr LobePixels kPixels = {kWidth, 0.003f};  // of 640 px and 90°, nearly

/// A bright horizon, brighter ahead than behind: what makes the most of rays that go wrong.
double luminanceFrom(const Eigen::Vector3f& towards) {
  const double z = static_cast<double>(towards.z()), x = static_cast<double>(towards.x());
  return std::exp(-3.0 * std::abs(z)) * (1.0 + 0.5 * x);
}

Surface seenFrom(double n_v, float roughness) {
  Surface surface;
  surface.position.setZero();
  surface.shading_normal = surface.geometric_normal = Eigen::Vector3f::UnitZ();
  surface.to_eye = Eigen::Vector3d(-std::sqrt(1.0 - n_v * n_v), 0.0, n_v).cast<float>();
  surface.albedo.setZero();
  surface.roughness = roughness;
  surface.samples = 4;
  return surface;
}

/// What the lobe of a black one shows, beside what it would show of 1 cd/m² from everywhere.
double byTheLobe(const Surface& surface) {
  constexpr int kHeights = 1500, kTurns = 1000;
  const Reflection reflection{surface.shading_normal, surface.to_eye, Eigen::Array3f::Zero(),
                              surface.roughness,      0.0f,           0.0f};
  double sum = 0.0, all = 0.0;
  for (int i = 0; i < kHeights; ++i) {
    const double step = (i + 0.5) / kHeights, z = step * step;  // closer to the horizon
    for (int k = 0; k < kTurns; ++k) {
      const double aside = 2.0 * (k + 0.5) / kTurns - 1.0;  // closer to straight ahead
      const double turn = kPi * aside * aside * aside, sine = std::sqrt(1.0 - z * z);
      const Eigen::Vector3f towards =
          Eigen::Vector3d(sine * std::cos(turn), sine * std::sin(turn), z).cast<float>();
      const double weight =
          step * aside * aside * static_cast<double>(directReflectance(reflection, towards, 0.0f)[0]);
      all += weight;
      sum += weight * luminanceFrom(towards);
    }
  }
  return sum / all;
}

// 160 by 160 pixels have 51,200 rays or more: half a per cent of noise. A lobe that leans the wrong way is 7
// % off where it is the flattest.
TEST(LobeRays, TogetherSeeWhatTheLobeDoes) {
  for (const double n_v : {0.03, 0.2, 0.6, 0.8}) {
    for (const float roughness : {0.12f, 0.25f, 0.35f, 0.45f}) {
      Surface surface = seenFrom(n_v, roughness);
      double sum = 0.0, weights = 0.0;
      for (surface.pixel = 0; surface.pixel < kWidth * kWidth; ++surface.pixel) {
        for (std::uint32_t k = 0; k < lobeRays(surface, kPixels); ++k) {
          const LobeRay ray = lobeRay(surface, surface.to_eye, kPixels, k);
          EXPECT_NEAR(ray.towards.norm(), 1.0f, 1e-5f);
          sum += static_cast<double>(ray.weight) * luminanceFrom(ray.towards);
          weights += static_cast<double>(ray.weight);
        }
      }
      const double expected = byTheLobe(surface);
      EXPECT_NEAR(sum / weights, expected, 0.015 * expected) << n_v << ", roughness " << roughness;
    }
  }
}

// Over all directions it is one, but for those below the surface; and what it weighs is what rays weigh.
TEST(LobeRays, AreAsDenseAsIsSaid) {
  for (const double n_v : {-0.05, 0.2, 0.6, 0.95}) {
    for (const float roughness : {0.2f, 0.45f}) {
      Surface surface = seenFrom(n_v, roughness);
      double sum = 0.0;
      constexpr int kHeights = 2000, kTurns = 2000;
      for (int i = 0; i < kHeights; ++i) {
        const double z = (i + 0.5) / kHeights, sine = std::sqrt(1.0 - z * z);
        for (int k = 0; k < kTurns; ++k) {
          const double turn = 2.0 * kPi * (k + 0.5) / kTurns;
          const Eigen::Vector3f towards =
              Eigen::Vector3d(sine * std::cos(turn), sine * std::sin(turn), z).cast<float>();
          sum += static_cast<double>(lobeAt(surface, surface.to_eye, towards).density);
        }
      }
      sum *= 2.0 * kPi / (kHeights * kTurns);
      int above = 0, all = 0;
      for (surface.pixel = 0; surface.pixel < kWidth * kWidth; ++surface.pixel) {
        for (std::uint32_t k = 0; k < lobeRays(surface, kPixels); ++k, ++all) {
          const LobeRay ray = lobeRay(surface, surface.to_eye, kPixels, k);
          if (!(ray.weight > 0.0f)) continue;
          ++above;
          const LobeAt at = lobeAt(surface, surface.to_eye, ray.towards);
          EXPECT_NEAR(at.weighted / at.density, ray.weight, 1e-3f * ray.weight);
        }
      }
      // 51,200 rays have 0.2 % of noise. Of an eye along the surface, or below, the sum is too coarse.
      if (n_v > 0.1) {
        EXPECT_NEAR(sum, static_cast<double>(above) / all, 0.01) << n_v << ", roughness " << roughness;
      }
    }
  }
}

// A wall of one colour that two tiles share, its rays half as bright as that in every second pixel and half
// as bright again in the others.
struct Floor {
  Surfaces surfaces;
  Reflections reflections;
  MirroredLuminances luminances;

  explicit Floor(float roughness) {
    surfaces.width = 2 * Surfaces::kTileSize;
    surfaces.height = Surfaces::kTileSize;
    surfaces.pixel_origin = Eigen::Vector3f::UnitX();
    surfaces.pixel_right = -kPixels.rad * Eigen::Vector3f::UnitY();
    surfaces.pixel_down = -kPixels.rad * Eigen::Vector3f::UnitZ();
    surfaces.tiles.resize(2);
    reflections.tiles.resize(2);
    luminances.resize(2);
    for (int x = 0; x < surfaces.width * surfaces.height; ++x) {
      const int column = x % surfaces.width, row = x / surfaces.width;
      const auto tile = static_cast<std::size_t>(column / Surfaces::kTileSize);
      Surface surface = seenFrom(0.3, roughness);
      surface.position =
          Eigen::Vector3f(0.1f * static_cast<float>(row), 0.1f * static_cast<float>(column), 0.0f);
      surface.pixel = static_cast<std::uint32_t>(x);
      Reflections::Mirroring mirroring;
      mirroring.surface = static_cast<std::uint32_t>(surfaces.tiles[tile].surfaces.size());
      mirroring.weight = 1.0f;
      surfaces.tiles[tile].surfaces.push_back(surface);
      reflections.tiles[tile].surfaces.push_back(mirroring);
      luminances[tile].push_back(Eigen::Array3f::Constant((column + row) % 2 == 0 ? 0.5f : 1.5f));
    }
  }
  void share() { shareLobes(surfaces, reflections, &luminances); }
};

TEST(SharedLobes, AreOfWholeBlocksAtEveryPixel) {
  Floor floor(0.35f);
  floor.share();
  for (const auto& tile : floor.luminances)
    for (const Eigen::Array3f& luminance : tile) EXPECT_NEAR(luminance[0], 1.0f, 1e-5f);
}

// A pixel of 64 px and 90° is as wide as most lobes.
TEST(SharedLobes, ReachNoFurtherThanALobeIsWide) {
  constexpr LobePixels kWide = {64, 0.03f};
  EXPECT_EQ(lobeReach(0.35f, kWide).down, 1u);
  EXPECT_EQ(lobeReach(0.15f, kPixels).down, 1u);
  EXPECT_EQ(lobeReach(0.2f, kPixels).down, 2u);
  EXPECT_EQ(lobeReach(0.35f, kPixels).down, 4u);
  EXPECT_EQ(lobeRays(seenFrom(0.3, 0.35f), kWide), 4u);
  EXPECT_EQ(lobeRays(seenFrom(0.3, 0.35f), kPixels), 2u);
  EXPECT_EQ(lobeRays(seenFrom(0.3, 0.05f), kPixels), 4u);
}

TEST(SharedLobes, LeaveSharpMirrorsAsTheyAre) {
  Floor floor(0.08f);
  floor.share();
  EXPECT_EQ(floor.luminances[0][0][0], 0.5f);
  EXPECT_EQ(floor.luminances[0][1][0], 1.5f);
}

// Rows 0 to 7, 0.1 m apart, mirror something bright, the others nothing. Where that is 0.25 m away, rows that
// are farther apart mirror different things.
TEST(SharedLobes, ReachNoFartherThanWhatTheyShowIsAway) {
  for (const float nearest_m : {0.25f, 100.0f}) {
    Floor floor(0.35f);
    for (std::size_t t = 0; t < floor.luminances.size(); ++t) {
      for (std::size_t i = 0; i < floor.luminances[t].size(); ++i) {
        floor.reflections.tiles[t].surfaces[i].nearest_m = nearest_m;
        const std::uint32_t row = floor.surfaces.tiles[t].surfaces[i].pixel / floor.surfaces.width;
        floor.luminances[t][i] = Eigen::Array3f::Constant(row < 8 ? 1.0f : 0.0f);
      }
    }
    floor.share();
    const auto of_row = [&](std::uint32_t row) {
      for (std::size_t i = 0; i < floor.luminances[0].size(); ++i)
        if (floor.surfaces.tiles[0].surfaces[i].pixel == row * floor.surfaces.width)
          return floor.luminances[0][i][0];
      return -1.0f;
    };
    EXPECT_EQ(of_row(5) == 1.0f, nearest_m < 1.0f) << nearest_m;
    EXPECT_EQ(of_row(10) == 0.0f, nearest_m < 1.0f) << nearest_m;
  }
}

// 16 pixels of a row have rays in all of the 4 by 4 cells that a lobe is cut into, as 4 by 4 pixels have.
TEST(LobeRays, OfARowSeeAllOfTheLobe) {
  Surface surface = seenFrom(0.6, 0.3f);
  const double expected = byTheLobe(surface);
  double squares = 0.0;
  constexpr std::uint32_t kRows = 64, kLong = 16;
  for (std::uint32_t row = 0; row < kRows; ++row) {
    double sum = 0.0, weights = 0.0;
    for (std::uint32_t x = 0; x < kLong; ++x) {
      surface.pixel = row * kWidth + x;
      for (std::uint32_t k = 0; k < lobeRays(surface, kPixels); ++k) {
        const LobeRay ray = lobeRay(surface, surface.to_eye, kPixels, k);
        sum += static_cast<double>(ray.weight) * luminanceFrom(ray.towards);
        weights += static_cast<double>(ray.weight);
      }
    }
    const double error = sum / weights / expected - 1.0;
    squares += error * error / kRows;
  }
  // 0.08 with rays of every part, 0.39 where a row has the same quarter of them throughout.
  EXPECT_LT(std::sqrt(squares), 0.12);
}

// The right tile's floor lies 0.1 m lower: none of its light comes over.
TEST(SharedLobes, EndAtAnEdge) {
  Floor floor(0.35f);
  for (Surface& surface : floor.surfaces.tiles[1].surfaces) surface.position.z() -= 0.1f;
  for (Eigen::Array3f& luminance : floor.luminances[1]) luminance *= 10.0f;
  floor.share();
  for (const Eigen::Array3f& luminance : floor.luminances[0]) EXPECT_LT(luminance[0], 1.2f);
  for (const Eigen::Array3f& luminance : floor.luminances[1]) EXPECT_GT(luminance[0], 8.0f);
}

}  // namespace
}  // namespace sunlit::light
