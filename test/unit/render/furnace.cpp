// In light of the same luminance from all sides a surface shows how much it sends back, and nothing else:
// that maps of roughness and metalness have just the say that factors have.
#include <gtest/gtest.h>

#include <cmath>

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
  chequer.rgba.assign(16, 255);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t which = i == 1 || i == 2 ? 1 : 0;
    chequer.rgba[4 * i + 1] = static_cast<std::uint8_t>(codes.rough[which]);
    chequer.rgba[4 * i + 2] = static_cast<std::uint8_t>(codes.metal[which]);
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

image::LinearImage picture(const scene::Scene& scene) {
  render::Renderer renderer(light::World(shared(scene)), smallCamera(96, 72, 50.0));
  renderer.look(lookingAt({0.0, -6.0, 5.0}, {0.0, 0.0, 1.0}));
  return renderer.light(furnace());
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

}  // namespace
}  // namespace sunlit::test
