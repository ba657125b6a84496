// Surfaces side by side are lit as one by one.
#include "light/picture/lamps/lit_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "light/shading/shading.h"
#include "light/shading/surface_reflection.h"

namespace sunlit::light {
namespace {

/// Of all kinds of materials, in turn.
scene::Scene paints() {
  scene::Scene scene;
  scene.materials.resize(4);
  scene.materials[1].transmission = 0.4f;
  scene.materials[2].glass = 0.9f;
  scene.materials[3].dielectric = LinearRgb(0.02f, 0.05f, 0.1f);
  scene.materials[3].dielectric_grazing = 0.5f;
  return scene;
}

class RandomTile {
 public:
  explicit RandomTile(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      Surface surface;
      surface.position = 20.0f * direction();
      surface.to_eye = direction();
      surface.geometric_normal = inHemisphere(surface.to_eye);
      surface.shading_normal = inHemisphere(surface.geometric_normal);
      surface.albedo = Eigen::Array3f(number(), number(), number());
      surface.roughness = 0.2f + 0.8f * number();
      surface.metalness = i % 3 == 0 ? number() : 0.0f;
      surface.material = static_cast<std::int32_t>(i % 4);
      tile.surfaces.push_back(surface);
    }
  }

  Tile tile;

 private:
  float number() { return std::uniform_real_distribution<float>(0.0f, 1.0f)(random_); }
  Eigen::Vector3f direction() {
    std::normal_distribution<float> normal;
    return Eigen::Vector3f(normal(random_), normal(random_), normal(random_)).normalized();
  }
  Eigen::Vector3f inHemisphere(const Eigen::Vector3f& about) {
    const Eigen::Vector3f one = direction();
    return one.dot(about) > 0.0f ? one : Eigen::Vector3f(-one);
  }
  std::mt19937 random_{5};
};

scene::Lamp spot(float exponent) {
  scene::Lamp lamp;
  lamp.position = {3.0f, -2.0f, 5.0f};
  lamp.direction = Eigen::Vector3f(0.3f, 0.1f, -1.0f).normalized();
  lamp.intensity = LinearRgb(700.0f, 500.0f, 200.0f);
  lamp.constant = 0.1f;
  lamp.linear = 0.2f;
  lamp.range_m = 22.0f;
  lamp.inner_rad = 0.4f;
  lamp.outer_rad = 1.5f;
  lamp.exponent = exponent;
  return lamp;
}

scene::Lamp bulb(float radius_m) {
  scene::Lamp lamp = spot(2.0f);
  lamp.range_m = std::numeric_limits<float>::infinity();
  lamp.inner_rad = lamp.outer_rad = scene::Lamp::kAllAround_rad;
  lamp.radius_m = radius_m;
  return lamp;
}

// 100 surfaces are not a whole number of blocks.
constexpr std::size_t kCount = 100;

TEST(LitRows, GetWhatABeamGivesToEachPoint) {
  const RandomTile random(kCount);
  LitRows rows;
  rows.set(random.tile, paints());
  ASSERT_EQ(rows.count(), kCount);
  for (const scene::Lamp& lamp : {spot(2.0f), spot(1.0f), spot(0.7f), bulb(0.05f)}) {
    const LampBeam beam(lamp);
    std::vector<float> shares(rows.stride());
    beam.shares(rows.positions(), shares.data());
    std::size_t lit = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
      const float share = beam.share(random.tile.surfaces[i].position);
      // At the very rim of a cone a share is what rounding leaves of a difference.
      EXPECT_NEAR(shares[i], share, 1e-5f * share + 1e-9f) << i;
      lit += share > 0.0f ? 1 : 0;
    }
    EXPECT_GT(lit, kCount / 10);
  }
}

TEST(LitRows, ReflectAsOneByOne) {
  const RandomTile random(kCount);
  const scene::Scene scene = paints();
  LitRows rows;
  rows.set(random.tile, scene);
  // Even share of light for all, so that dim ones tell as much; a ball of 8 m holds some of the surfaces.
  const std::vector<float> shares(rows.stride(), 0.01f), least_lx(rows.stride(), 0.0f);
  for (const float radius_m : {0.0f, 0.05f, 2.0f, 8.0f}) {
    const LampBeam beam(bulb(radius_m));
    LitRows::Reflected reflected;
    rows.reflect(beam, {shares.data(), least_lx.data()}, &reflected);
    EXPECT_EQ(reflected.blocks.size(), rows.stride() / LitRows::kBlock);
    for (std::size_t i = 0; i < kCount; ++i) {
      const Surface& surface = random.tile.surfaces[i];
      const Reflection reflection =
          reflectionOf(surface, scene.materials[static_cast<std::size_t>(surface.material)]);
      const Eigen::Vector3f way = beam.position() - surface.position;
      const bool lost = surface.geometric_normal.dot(way) <= 0.0f && !(reflection.transmission > 0.0f);
      const Eigen::Array3f expected =
          lost ? Eigen::Array3f(Eigen::Array3f::Zero())
               : Eigen::Array3f(
                     directReflectance(reflection, way.normalized(), std::atan(radius_m / way.norm())) *
                     beam.intensity() * 0.01f);
      float largest = 0.0f;
      for (std::size_t c = 0; c < 3; ++c) {
        const float value = reflected.values[c * rows.stride() + i];
        largest = std::max(largest, value);
        // Half of atan() within 0.003 widens lobes whose α is 0.04 and more by up to 2 % beside a ball as
        // wide as it is far; else single precision.
        const float tolerance = radius_m > 1.0f ? 0.03f : 1e-3f;
        EXPECT_NEAR(value, expected[static_cast<Eigen::Index>(c)],
                    tolerance * expected[static_cast<Eigen::Index>(c)] + 1e-6f)
            << i << " by a ball of " << radius_m;
      }
      EXPECT_EQ(largest, reflected.values[3 * rows.stride() + i]);
    }
  }
}

TEST(LitRows, LeaveOutWhatGetsTooLittle) {
  const RandomTile random(kCount);
  LitRows rows;
  rows.set(random.tile, paints());
  const LampBeam beam(bulb(0.05f));
  const std::vector<float> shares(rows.stride(), 0.01f);
  std::vector<float> least_lx(rows.stride(), 1.1f * 0.01f * beam.brightest());
  const std::size_t only = 2 * LitRows::kBlock + 3;
  least_lx[only] = 0.0f;
  LitRows::Reflected reflected;
  rows.reflect(beam, {shares.data(), least_lx.data()}, &reflected);
  ASSERT_EQ(reflected.blocks, std::vector<std::uint32_t>{2 * LitRows::kBlock});
  for (std::size_t k = 0; k < LitRows::kBlock; ++k) {
    const std::size_t i = reflected.blocks[0] + k;
    if (i != only) {
      EXPECT_EQ(reflected.values[3 * rows.stride() + i], 0.0f) << k;
    }
  }
}

}  // namespace
}  // namespace sunlit::light
