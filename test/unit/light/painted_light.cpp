// What surfaces pass on in the bake is what their textures show, beside the path tracer.
#include <gtest/gtest.h>

#include "baked_scene.h"
#include "light/shading/reflectances.h"

namespace sunlit::light {
namespace {

scene::Texture row(const std::vector<std::uint8_t>& greys, std::uint8_t alpha = 255) {
  scene::Texture texture;
  texture.width = static_cast<int>(greys.size());
  texture.height = 1;
  for (const std::uint8_t grey : greys)
    texture.rgba.own().insert(texture.rgba.own().end(), {grey, grey, grey, alpha});
  return texture;
}

/// A colour of a palette, as makers of models paint whole parts by one texel: `texel` of `count` is white,
/// all others are black.
scene::Texture palette(int count, int texel) {
  std::vector<std::uint8_t> greys(static_cast<std::size_t>(count), 0);
  greys[static_cast<std::size_t>(texel)] = 255;
  return row(greys);
}

void setTextureCoordinates(scene::Mesh* mesh, float u) {
  mesh->texture_coordinates.assign(mesh->positions.size(), {u, 0.5f});
}

/// Points of the ground beside what stands at the origin, seen from above.
std::vector<Looked> groundBeside() {
  std::vector<Looked> points;
  for (const float x : {0.5f, 1.0f, 2.0f, 3.0f})
    points.push_back({{x, 0.3f, 0.0f}, Eigen::Vector3f::UnitZ(), {0.3f, 0.1f, 1.0f}, 0});
  return points;
}

class Palette : public ::testing::TestWithParam<int> {};

TEST_P(Palette, LightsItsSurroundingsByTheTexelThatIsUsed) {
  const int count = GetParam(), texel = count / 3;
  scene::Scene scene;
  scene.textures = {palette(count, texel)};
  scene.materials = {paint(0.4f), paint(0.8f)};
  addGround(&scene, 0, 100.0f);
  addPatch(&scene, 1, {0.0f, -4.0f, 0.0f}, {0.0f, 8.0f, 0.0f}, {0.0f, 0.0f, 4.0f});
  setTextureCoordinates(&scene.meshes.back(), (static_cast<float>(texel) + 0.5f) / static_cast<float>(count));
  const std::vector<double> white = fast(baked(scene), groundBeside(), uniformDay(100.0f));
  scene.materials[1].base_texture = 0;
  const std::vector<double> painted = fast(baked(scene), groundBeside(), uniformDay(100.0f));
  for (std::size_t i = 0; i < white.size(); ++i) EXPECT_NEAR(painted[i] / white[i], 1.0, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Palette, ::testing::Values(2, 8, 16, 31, 33, 100, 256));

TEST(PaintedLight, OfWhatShinesInStripesIsThatOfAllStripes) {
  scene::Scene scene;
  // A panel over a quarter of the tile, clear of its ends.
  scene.textures = {row({0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 0, 0, 0, 0, 0, 0})};
  scene.materials = {paint(0.4f), paint(0.0f, 25.0f)};
  addGround(&scene, 0, 100.0f);
  addPatch(&scene, 1, {-4.0f, 4.0f, 2.5f}, {8.0f, 0.0f, 0.0f}, {0.0f, -8.0f, 0.0f});  // it looks down
  const std::vector<double> even = fast(baked(scene), groundBeside(), uniformDay(0.0f));
  scene.materials[1].emission = LinearRgb(100.0f, 100.0f, 100.0f);
  scene.materials[1].emission_map = {0, 0, 0};
  // Stripes of 25 and 12.5 cm, 2.5 m above: hardly to be told from an even panel.
  for (const float repeats : {8.0f, 16.0f}) {
    for (Eigen::Vector2f& uv : scene.meshes.back().texture_coordinates)
      uv.x() = uv.x() > 0.0f ? repeats : 0.0f;
    const std::vector<double> striped = fast(baked(scene), groundBeside(), uniformDay(0.0f));
    for (std::size_t i = 0; i < even.size(); ++i) EXPECT_NEAR(striped[i] / even[i], 1.0, 0.03) << repeats;
  }
}

TEST(PaintedLight, CountsTexelsThatAlphaDoesNotHide) {
  // glTF ignores the alpha of what is opaque, and that of what shines.
  scene::Scene scene;
  scene.textures = {row({255, 0, 0, 0})};
  for (std::size_t i = 7; i < 16; i += 4) scene.textures[0].rgba.own()[i] = 0;
  for (int k = 0; k < 16; ++k) {  // too wide for squares of single texels
    scene::Texture& wide = scene.textures[0];
    if (wide.width < 64) {
      const std::vector<std::uint8_t> bytes(wide.rgba.begin(), wide.rgba.end());
      wide.rgba.own().insert(wide.rgba.own().end(), bytes.begin(), bytes.end());
      wide.width *= 2;
    }
  }
  scene.materials = {paint(1.0f, 100.0f), paint(1.0f)};
  scene.materials[0].base_texture = scene.materials[1].base_texture = 0;
  scene.materials[0].emission_map = {0, 0, 0};
  scene.materials[1].alpha_mode = scene::AlphaMode::kMask;
  addPatch(&scene, 0, {0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
  addPatch(&scene, 1, {0.0f, 0.0f, 1.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
  const World world = worldOf(scene);
  const Reflectances reflectances(*world.geometry);
  const Reflectances::Part whole = Reflectances::Part::Identity();
  const auto of = [&](int material) {
    std::uint32_t t = 0;
    while (world.geometry->materials[t] != material) ++t;
    return t;
  };
  EXPECT_NEAR(reflectances.mean({of(0), true}, whole).albedo[1], 0.25f, 0.04f);  // of 16 points
  EXPECT_NEAR(reflectances.emission(of(0), whole)[1], 25.0f, 2.0f);
  EXPECT_NEAR(reflectances.mean({of(1), true}, whole).albedo[1], 1.0f,
              0.02f);  // what is cut out is not there
}

}  // namespace
}  // namespace sunlit::light
