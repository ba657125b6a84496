// What is baked into textures looks as what was there before.
#include "sunlit/render/baked_looks.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "support/message_of.h"
#include "test_scenes.h"

namespace sunlit::render {
namespace {

BakedLooksOptions texelsOf(double texel_m) {
  BakedLooksOptions options;
  options.texel_m = texel_m;
  return options;
}

/// What is seen of it from 3 m above under the sun.
image::LinearImage pictureOf(const scene::Scene& scene) {
  Renderer renderer(light::World(test::shared(scene)), test::smallCamera(120, 90, 40.0));
  renderer.look(test::lookingAt({0.13, 0.07, 3.0}, {0.13, 0.07, 0.0}));
  return renderer.light(light::Illumination(test::daylightAt(160.0, 50.0)));
}

/// Mean of |a − b| over the mean of a.
double differenceOf(const image::LinearImage& a, const image::LinearImage& b) {
  double off = 0.0, all = 0.0;
  for (std::size_t i = 0; i < a.data.size(); ++i) {
    off += std::abs(static_cast<double>(a.data[i]) - static_cast<double>(b.data[i]));
    all += static_cast<double>(a.data[i]);
  }
  return off / all;
}

/// 4 m by 4 m of squares whose corners have colours of their own.
scene::Scene colorful(float contrast) {
  scene::Scene scene;
  scene.materials.emplace_back();
  scene.materials[0].base_color = LinearRgb(0.5f, 0.4f, 0.3f);
  scene.materials[0].detail.contrast = contrast;
  scene.materials[0].detail.coarsest_m = 1.0f;
  scene.materials[0].detail.finest_m = 0.25f;
  for (int x = -2; x < 2; ++x) {
    for (int y = -2; y < 2; ++y) {
      test::addPatch(&scene, 0, Eigen::Vector3f(static_cast<float>(x), static_cast<float>(y), 0.0f),
                     {1, 0, 0}, {0, 1, 0});
      const auto color = [](int i, int k) {
        return Eigen::Array3f(0.6f + 0.1f * static_cast<float>(i), 0.8f, 0.7f + 0.1f * static_cast<float>(k));
      };
      scene.meshes.back().colors = {color(x, y), color(x + 1, y), color(x + 1, y + 1), color(x, y + 1)};
    }
  }
  return scene;
}

void expectWithoutLooks(const scene::Scene& scene) {
  for (const scene::Mesh& mesh : scene.meshes) EXPECT_TRUE(mesh.colors.empty());
  for (const scene::Material& material : scene.materials) EXPECT_EQ(material.detail.contrast, 0.0f);
  scene::validate(scene);
}

TEST(BakedLooks, ShowColoursAndDetailAsTheyWere) {
  const scene::Scene scene = colorful(0.3f);
  const BakedLooks looks(scene, texelsOf(0.01));
  const scene::Scene baked = looks.make({});
  expectWithoutLooks(baked);
  EXPECT_EQ(baked.triangleCount(), scene.triangleCount());
  ASSERT_EQ(baked.textures.size(), looks.pages());
  // Half a percent is what 8 bits and the way between texels leave.
  EXPECT_LT(differenceOf(pictureOf(scene), pictureOf(baked)), 0.005);
  scene::Scene flat = baked;  // and without them it is another picture
  for (scene::Material& material : flat.materials) material.base_texture = scene::Material::kNoTexture;
  EXPECT_GT(differenceOf(pictureOf(scene), pictureOf(flat)), 0.1);
}

TEST(BakedLooks, CoarserTexelsShowLess) {
  const scene::Scene scene = colorful(0.3f);
  const image::LinearImage truth = pictureOf(scene);
  const double fine = differenceOf(truth, pictureOf(BakedLooks(scene, texelsOf(0.02)).make({})));
  const double coarse = differenceOf(truth, pictureOf(BakedLooks(scene, texelsOf(0.4)).make({})));
  EXPECT_GT(coarse, 5.0 * fine);
}

TEST(BakedLooks, KeepTheTextureBeneath) {
  scene::Scene scene = colorful(0.0f);
  scene::Texture texture;
  texture.width = texture.height = 8;
  for (int i = 0; i < 64; ++i) {
    const auto value = static_cast<std::uint8_t>((i / 8 + i) % 2 == 0 ? 255 : 60);
    for (const std::uint8_t channel : {value, value, value, std::uint8_t{255}})
      texture.rgba.own().push_back(channel);
  }
  scene.textures = {texture};
  scene.materials[0].base_texture = 0;
  const scene::Scene baked = BakedLooks(scene, texelsOf(0.01)).make({});
  expectWithoutLooks(baked);
  EXPECT_EQ(baked.textures.size(), 1u);  // the old one is not used any more
  // Edges between texels are drawn anew, at most a texel of 1 cm along each of 8 edges of 1 m.
  EXPECT_LT(differenceOf(pictureOf(scene), pictureOf(baked)), 0.02);
}

TEST(BakedLooks, TintWhatIsCutOut) {
  scene::Scene scene = colorful(0.0f);
  scene::Texture texture;
  texture.width = texture.height = 2;
  texture.rgba.own().assign(16, 255);
  texture.rgba.own()[3] = 0;
  scene.textures = {texture};
  scene.materials[0].base_texture = 0;
  scene.materials[0].alpha_mode = scene::AlphaMode::kMask;
  for (scene::Mesh& mesh : scene.meshes) mesh.colors.assign(4, mesh.colors[0]);
  const BakedLooks looks(scene, texelsOf(0.01));
  EXPECT_EQ(looks.pages(), 0u);
  const scene::Scene baked = looks.make({});
  expectWithoutLooks(baked);
  EXPECT_EQ(baked.textures.size(), 1u);
  // By steps of 1/32 of a root: at most 1/32 of colours of about 0.6.
  EXPECT_LT(differenceOf(pictureOf(scene), pictureOf(baked)), 0.03);
}

TEST(BakedLooks, TintGlassAndNameWhatItLoses) {
  scene::Scene scene = colorful(0.3f);
  scene.materials[0].glass = 0.9f;
  const BakedLooks looks(scene, texelsOf(0.01));
  EXPECT_EQ(looks.pages(), 0u);
  ASSERT_EQ(looks.notes().size(), 1u);
  EXPECT_NE(looks.notes()[0].find("glass"), std::string::npos) << looks.notes()[0];
  const scene::Scene baked = looks.make({});
  expectWithoutLooks(baked);
  for (const scene::Material& material : baked.materials) EXPECT_EQ(material.glass, 0.9f);
}

TEST(BakedLooks, LeaveAloneWhatHasNeither) {
  scene::Scene scene;
  scene.materials.emplace_back();
  test::addGround(&scene, 0, 10.0f);
  const BakedLooks looks(scene, texelsOf(0.01));
  EXPECT_EQ(looks.pages(), 0u);
  const scene::Scene same = looks.make({});
  EXPECT_EQ(same.meshes[0].positions, scene.meshes[0].positions);
  EXPECT_TRUE(same.textures.empty());
}

TEST(BakedLooks, AreCoarserFarFromWhereTheyAreSeen) {
  const scene::Scene scene = colorful(0.3f);
  BakedLooksOptions options = texelsOf(0.01);
  const std::size_t everywhere = BakedLooks(scene, options).texels();
  options.eyes = {{0.0, 0.0, 5.0}};
  EXPECT_EQ(BakedLooks(scene, options).texels(), everywhere);
  options.eyes = {{0.0, 0.0, 100.0}};
  // A tenth along each side, and gutters.
  EXPECT_LT(BakedLooks(scene, options).texels(), everywhere / 20);
}

TEST(BakedLooks, ThatAreTooManyAreRefusedWithATexelThatFits) {
  scene::Scene scene = colorful(0.3f);
  for (scene::Mesh& mesh : scene.meshes)
    for (Eigen::Vector3f& position : mesh.positions) position *= 100.0f;
  const std::string error = messageOf([&] { BakedLooks(scene, texelsOf(0.01)); });
  const std::size_t end = error.find(" m fits");
  ASSERT_NE(end, std::string::npos) << error;
  const double fits = std::stod(error.substr(error.rfind(' ', end - 1)));
  EXPECT_GT(fits, 0.01);
  EXPECT_LE(BakedLooks(scene, texelsOf(fits)).texels(), BakedLooks::kMost);
  // 400 m by 400 m: no finer one would.
  EXPECT_GT(1.2 * fits, 400.0 / std::sqrt(static_cast<double>(BakedLooks::kMost)));
}

TEST(BakedLooks, NameWhatIsTooLargeForAPage) {
  scene::Scene scene = colorful(0.3f);
  for (Eigen::Vector3f& position : scene.meshes[0].positions) position *= 100.0f;
  const BakedLooks looks(scene, texelsOf(0.01));
  ASSERT_EQ(looks.notes().size(), 1u);
  EXPECT_EQ(looks.notes()[0].find("1 surfaces are too large"), 0u) << looks.notes()[0];
}

TEST(BakedLooks, AreTheSameBitsForAnyNumberOfThreads) {
  const scene::Scene scene = colorful(0.3f);
  const scene::Scene with_all = BakedLooks(scene, texelsOf(0.05)).make({});
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(BakedLooks(scene, texelsOf(0.05)).make({}).textures[0].rgba, with_all.textures[0].rgba);
}

}  // namespace
}  // namespace sunlit::render
