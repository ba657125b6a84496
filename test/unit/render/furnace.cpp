// In light of the same luminance from all sides a surface shows how much it sends back, and nothing else:
// that maps of roughness and metalness have just the say that factors have.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sunlit/scene/weathering.h"
#include "sunlit/sky/uniform_sky.h"
#include "test_scenes.h"

namespace sunlit::test {
namespace {

constexpr float kLuminance = 100.0f;

sky::Daylight furnace() {
  sky::UniformSky sky;
  sky.luminance = LinearRgb(kLuminance, kLuminance, kLuminance);
  sky.ground_albedo = 1.0;
  return sky::uniformDaylight(sky);
}

/// Of a chequer of two by two: green is roughness, blue is metalness.
struct Codes {
  int rough[2], metal[2];
};

/// Level ground of 8 m by 8 m and a ball above it, with `repeats` of the chequer each.
scene::Scene planeAndBall(float repeats) {
  scene::Scene scene;
  addMaterial(&scene, Eigen::Array3f(0.9f, 0.6f, 0.3f));
  addGround(&scene, 0, 4.0f);
  for (Eigen::Vector2f& coordinate : scene.meshes[0].texture_coordinates) coordinate *= repeats;
  scene::Mesh ball;
  ball.material = 0;
  constexpr int kRings = 48, kSectors = 96;
  for (int r = 0; r <= kRings; ++r) {
    for (int s = 0; s <= kSectors; ++s) {
      const float down = kPiFloat * static_cast<float>(r) / kRings;
      const float turn = 2.0f * kPiFloat * static_cast<float>(s) / kSectors;
      const Eigen::Vector3f out(std::sin(down) * std::cos(turn), std::sin(down) * std::sin(turn),
                                std::cos(down));
      ball.normals.push_back(out);
      ball.positions.push_back(out + Eigen::Vector3f(0.0f, 0.0f, 2.0f));
      ball.texture_coordinates.emplace_back(repeats * static_cast<float>(s) / kSectors,
                                            repeats * static_cast<float>(r) / kRings);
    }
  }
  for (std::uint32_t r = 0; r < kRings; ++r) {
    for (std::uint32_t s = 0; s < kSectors; ++s) {
      const std::uint32_t a = r * (kSectors + 1) + s, b = a + kSectors + 1;
      ball.triangles.push_back({a, b, b + 1});
      ball.triangles.push_back({a, b + 1, a + 1});
    }
  }
  scene.meshes.push_back(ball);
  return scene;
}

scene::Scene textured(const Codes& codes, float repeats) {
  scene::Scene scene = planeAndBall(repeats);
  scene::Texture chequer;
  chequer.name = "chequer";
  chequer.width = chequer.height = 2;
  chequer.rgba.own().assign(16, 255);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t which = i == 1 || i == 2 ? 1 : 0;
    chequer.rgba.own()[4 * i + 1] = static_cast<std::uint8_t>(codes.rough[which]);
    chequer.rgba.own()[4 * i + 2] = static_cast<std::uint8_t>(codes.metal[which]);
  }
  scene.textures = {chequer};
  scene.materials[0].roughness = scene.materials[0].metalness = 1.0f;
  scene.materials[0].roughness_map = {0, 0, 1};
  scene.materials[0].metalness_map = {0, 0, 2};
  return scene;
}

scene::Scene plain(float rough_code, float metal_code) {
  scene::Scene scene = planeAndBall(1.0f);
  scene.materials[0].roughness = rough_code / 255.0f;
  scene.materials[0].metalness = metal_code / 255.0f;
  return scene;
}

image::LinearImage picture(const light::World& world) {
  render::Renderer renderer(world, smallCamera(96, 72, 50.0));
  renderer.look(lookingAt({0.0, -6.0, 5.0}, {0.0, 0.0, 1.0}));
  return renderer.light(furnace());
}

image::LinearImage picture(const scene::Scene& scene) {
  return picture(light::World(shared(scene)));
}

/// The largest relative difference of two pictures of the furnace.
float apart(const image::LinearImage& a, const image::LinearImage& b) {
  float most = 0.0f;
  for (std::size_t i = 0; i < a.data.size(); ++i)
    most = std::max(most, std::abs(a.data[i] - b.data[i]) / kLuminance);
  return most;
}

TEST(TexturedFurnace, ReflectsByOneTexelAsByFactors) {
  for (const auto& [rough, metal] : {std::pair(64, 0), std::pair(128, 255), std::pair(255, 100)}) {
    const image::LinearImage by_map = picture(textured({{rough, rough}, {metal, metal}}, 5.0f));
    const image::LinearImage by_factor = picture(plain(static_cast<float>(rough), static_cast<float>(metal)));
    EXPECT_LT(apart(by_map, by_factor), 1e-4f) << rough << ' ' << metal;
  }
}

TEST(TexturedFurnace, OfAFineChequerReflectsAsOfItsMean) {
  // Some hundred texels a pixel: the mean of the numbers, which 8 bits of small sizes keep to half a code, a
  // 500th of each; beside it lights of lobes change by less.
  const image::LinearImage by_map = picture(textured({{100, 220}, {40, 240}}, 4000.0f));
  EXPECT_LT(apart(by_map, picture(plain(160.0f, 140.0f))), 0.004f);
  // A mean as of colours (of 40 and 240: about 180) would be seen.
  EXPECT_GT(apart(by_map, picture(plain(160.0f, 188.0f))), 0.01f);
}

/// The most that level ground of `world` sends back where it is looked at by so much from above its normal,
/// and up to 3° beside, in parts of what arrives.
float mostSentBack(const light::World& world, double angle_deg) {
  render::Renderer renderer(world, smallCamera(32, 24, 8.0));
  const double angle = angle_deg * kRadPerDeg;
  renderer.look(lookingAt({0.0, -3.0 * std::sin(angle), 3.0 * std::cos(angle)}, Eigen::Vector3d::Zero()));
  const image::LinearImage seen = renderer.light(furnace());
  return *std::max_element(seen.data.begin(), seen.data.end()) / kLuminance;
}

struct Weathered {
  double wet, puddles, snow_m;
  float albedo;         ///< of the ground when dry
  double flattest_deg;  ///< the flattest look at it
};

class WeatheredFurnace : public ::testing::TestWithParam<Weathered> {};

TEST_P(WeatheredFurnace, SendsBackNoMoreThanArrives) {
  const Weathered& asked = GetParam();
  scene::SurfaceState state;
  state.wet = asked.wet;
  state.puddles = asked.puddles;
  state.snow_m = asked.snow_m;
  for (const float roughness : {0.1f, 0.5f, 1.0f}) {
    scene::Scene level;
    addMaterial(&level, Eigen::Array3f::Constant(asked.albedo));
    level.materials[0].roughness = roughness;
    addGround(&level, 0, 50.0f);
    const light::World weathered = light::weathered(light::World(shared(level)), state);
    for (double angle_deg = 5.0; angle_deg <= asked.flattest_deg; angle_deg += 15.0)
      EXPECT_LE(mostSentBack(weathered, angle_deg), 1.001f) << roughness << " at " << angle_deg;
  }
}

// Shading takes from the scattered light what is mirrored as glTF 2.0 does, by the half vector: of a glossy
// ground that is light too little beyond 80°, dry or wet. Grounds of 0.3 send back 0.82 there, those of 0.8
// up to 0.97 at 70°. Snow, as rough as can be, does not: at most 0.92.
INSTANTIATE_TEST_SUITE_P(States, WeatheredFurnace,
                         ::testing::Values(Weathered{1.0, 0.0, 0.0, 0.3f, 80.0},
                                           Weathered{0.0, 0.9, 0.0, 0.3f, 80.0},
                                           Weathered{1.0, 0.9, 0.0, 0.8f, 65.0},
                                           Weathered{0.0, 0.0, 0.1, 0.8f, 85.0},
                                           Weathered{1.0, 0.9, 0.3, 0.8f, 85.0}));

}  // namespace
}  // namespace sunlit::test
