// Masks cut the same holes into picture and shadow, at any distance; culling never takes away what is in
// view.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "render/frustum.h"
#include "render/mipmaps.h"
#include "test_scenes.h"

namespace sunlit::test {
namespace {

/// 64 × 64, transparent but for the left half and, of that, the lower quarter: no symmetry.
scene::Texture stencil() {
  scene::Texture texture{"stencil", 64, 64, std::vector<std::uint8_t>(64 * 64 * 4, 255)};
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool solid = x < 32 && y < 48;
      texture.rgba.own()[static_cast<std::size_t>(4 * (64 * y + x) + 3)] = solid ? 255 : 0;
    }
  }
  return texture;
}

TEST(Mask, CutsTheSameHolesIntoPictureAndShadow) {
  scene::Scene scene;
  scene.textures.push_back(stencil());
  const int ground = addMaterial(&scene, {0.5f, 0.5f, 0.5f});
  const int masked = addMaterial(&scene, {0.5f, 0.5f, 0.5f});
  scene.materials[1].base_texture = 0;
  scene.materials[1].alpha_mode = scene::AlphaMode::kMask;
  addGround(&scene, ground, 50.0f);
  // A level sheet 2 m up, 8 m × 8 m: s runs east, t runs south, as in a map.
  addPatch(&scene, masked, {-4.0f, 4.0f, 2.0f}, {8.0f, 0.0f, 0.0f}, {0.0f, -8.0f, 0.0f});
  render::Renderer renderer(shared(scene), smallCamera(160, 120, 60.0));
  const sky::Daylight day = daylightAt(180.0, 89.0);

  // In the picture, from above: solid in the west, but for the southernmost quarter.
  render::RenderOptions map_options;
  map_options.camera = image::PinholeCamera{100, 100, 500.0, 500.0, 49.5, 49.5};
  render::Renderer map(shared(scene), map_options);
  map.look(lookingAt({0.0, 0.0, 52.0}, {0.0, 0.0, 0.0}));  // 10 px a metre at the sheet's height
  const image::DepthImage depth = map.depth();
  const auto height = [&](double east, double north) {
    return 52.0f - *depth.at(static_cast<int>(std::lround(49.5 + 10.0 * east)),
                             static_cast<int>(std::lround(49.5 - 10.0 * north)));
  };
  EXPECT_NEAR(height(-2.0, 2.0), 2.0, 1e-3);
  EXPECT_NEAR(height(-2.0, -1.0), 2.0, 1e-3);
  EXPECT_NEAR(height(-2.0, -3.0), 0.0, 1e-3);
  EXPECT_NEAR(height(2.0, 2.0), 0.0, 1e-3);

  // In the shadow, from beneath the sheet.
  const auto ground_light = [&](double east, double north) {
    renderer.look(lookingAt({east, north, 1.0}, {east, north, 0.0}));
    return at(renderer.light(day), 80, 60)[1];
  };
  const float lit = ground_light(20.0, 20.0);
  EXPECT_LT(ground_light(-2.0, 2.0), 0.5f * lit);
  EXPECT_LT(ground_light(-2.0, -1.0), 0.5f * lit);
  EXPECT_GT(ground_light(-2.0, -3.0), 0.9f * lit);
  EXPECT_GT(ground_light(2.0, 2.0), 0.9f * lit);
}

/// How high above the ground lies what is seen straight from above at (1, 1) and (−1, 1), where two sheets
/// with one texture of a half's alpha, cut off at these values, lie 2 m up.
std::array<float, 2> heightsOfSheets(const std::array<float, 2>& cutoffs) {
  scene::Scene scene;
  scene.textures.push_back({"veil", 4, 4, std::vector<std::uint8_t>(4 * 4 * 4, 128)});
  addGround(&scene, addMaterial(&scene, {0.5f, 0.5f, 0.5f}), 50.0f);
  for (std::size_t i = 0; i < 2; ++i) {
    const int material = addMaterial(&scene, {0.5f, 0.5f, 0.5f});
    scene.materials.back().base_texture = 0;
    scene.materials.back().alpha_mode = scene::AlphaMode::kMask;
    scene.materials.back().alpha_cutoff = cutoffs[i];
    addPatch(&scene, material, {i == 0 ? 0.0f : -2.0f, 0.0f, 2.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 2.0f, 0.0f});
  }
  render::Renderer renderer(shared(scene), smallCamera());
  std::array<float, 2> heights;
  for (std::size_t i = 0; i < 2; ++i) {
    const double east = i == 0 ? 1.0 : -1.0;
    renderer.look(lookingAt({east, 1.0, 12.0}, {east, 1.0, 0.0}));
    heights[i] = 12.0f - *renderer.depth().at(80, 60);
  }
  return heights;
}

TEST(Mask, HasTheCutoffOfItsMaterialWhereTwoShareATexture) {
  const std::array<float, 2> solid_first = heightsOfSheets({0.4f, 0.6f});
  EXPECT_NEAR(solid_first[0], 2.0f, 1e-3);
  EXPECT_NEAR(solid_first[1], 0.0f, 1e-3);
  const std::array<float, 2> clear_first = heightsOfSheets({0.6f, 0.4f});
  EXPECT_NEAR(clear_first[0], 0.0f, 1e-3);
  EXPECT_NEAR(clear_first[1], 2.0f, 1e-3);
}

double solidShare(const scene::Texels& rgba, float cutoff) {
  std::size_t solid = 0;
  for (std::size_t i = 3; i < rgba.size(); i += 4)
    solid += static_cast<float>(rgba[i]) >= 255.0f * cutoff ? 1 : 0;
  return 4.0 * static_cast<double>(solid) / static_cast<double>(rgba.size());
}

TEST(Mipmap, OfAMaskLetsAsMuchThroughAsTheFullTexture) {
  // A fifth is solid, strewn at random. Averages tend to the middle: without care all of it vanishes by the
  // third level.
  scene::Texture hedge{"hedge", 128, 128, std::vector<std::uint8_t>(128 * 128 * 4, 200)};
  std::minstd_rand random(3);
  for (std::size_t i = 0; i < 128 * 128; ++i)
    hedge.rgba.own()[4 * i + 3] = static_cast<std::uint8_t>(random() % 256);
  const double share = solidShare(hedge.rgba, 0.8f);
  const auto levels = render::smallerLevels(hedge, 0.8f);
  ASSERT_EQ(levels.size(), 7u);
  for (std::size_t i = 0; i < 3; ++i) {  // beyond, a level has too few texels to speak of a share
    // Averages crowd into ever fewer of the 256 codes of alpha, and texels of one code come or go together.
    EXPECT_NEAR(solidShare(levels[i].rgba, 0.8f), share, 0.03) << "level " << i + 1;
  }
}

TEST(Mipmap, AveragesLightAndNotCodes) {
  // Half black, half white is 50 % of the light: code 188, not 128.
  scene::Texture texture{"stripes", 2, 1, {0, 0, 0, 255, 255, 255, 255, 255}};
  const auto levels = render::smallerLevels(texture, render::kNoCutoff);
  ASSERT_EQ(levels.size(), 1u);
  EXPECT_EQ(levels[0].rgba[0], 188);
  EXPECT_EQ(levels[0].rgba[3], 255);
}

TEST(Mipmap, KeepsTheColourOfWhatIsCutOutFromBleedingIn) {
  scene::Texture texture{"leaf", 2, 1, {0, 200, 0, 255, 255, 255, 255, 0}};
  const auto levels = render::smallerLevels(texture, 0.5f);
  EXPECT_LT(levels[0].rgba[0], 8);  // of the invisible texel a weight of 1e-4 is left, 3 codes
  EXPECT_NEAR(levels[0].rgba[1], 200, 1);
}

TEST(Mipmap, OfOddSizesUsesEveryTexel) {
  scene::Texture texture{"odd", 3, 1, {0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 255}};
  const auto levels = render::smallerLevels(texture, render::kNoCutoff);
  ASSERT_EQ(levels.size(), 1u);
  EXPECT_EQ(levels[0].width, 1);
  EXPECT_EQ(levels[0].rgba[0], 156);  // a third of the light: 1.055 · (1/3)^(1/2.4) − 0.055 = 0.612
}

TEST(Frustum, KeepsEveryBoxThatHasAPointInView) {
  render::View view;
  view.camera = image::PinholeCamera::fromFieldOfView(160, 120, Angle::degrees(60.0));
  view.camera.cx += 20.0;
  view.map_from_optical = lookingAt({10.0, -5.0, 3.0}, {40.0, 20.0, 1.0});
  const render::Frustum frustum(view);
  std::minstd_rand random(5);
  const auto uniform = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max());
  };
  int culled = 0;
  for (int i = 0; i < 2000; ++i) {
    // A box about a point that is in view, at any depth.
    const Eigen::Vector3d point =
        view.map_from_optical *
        (uniform(0.1, 500.0) * view.camera.unproject({uniform(-0.4, 159.4), uniform(-0.4, 119.4)}));
    const Eigen::Vector3d low(uniform(0.0, 9.0), uniform(0.0, 9.0), uniform(0.0, 9.0)),
        high(uniform(0.0, 9.0), uniform(0.0, 9.0), uniform(0.0, 9.0));
    EXPECT_TRUE(frustum.touches({(point - low).cast<float>(), (point + high).cast<float>()}));
    const Eigen::Vector3d anywhere(uniform(-300.0, 300.0), uniform(-300.0, 300.0), uniform(-9.0, 9.0));
    culled += frustum.touches({anywhere.cast<float>(), (anywhere + high).cast<float>()}) ? 0 : 1;
  }
  // The view spans 60° of 360°, so about five sixths of what lies around is out of it.
  EXPECT_GT(culled, 1400);
}

TEST(Picture, IsTheSameWhetherAnObjectIsOneMeshOrSpreadOverCells) {
  // The same patches in many cells and in one: a wide mesh is split into cells of its own, here by moving all
  // by 32 m.
  const auto scene = [](float shift) {
    scene::Scene s;
    const int material = addMaterial(&s, {0.5f, 0.4f, 0.3f});
    std::minstd_rand random(7);
    for (int i = 0; i < 400; ++i) {
      const auto x = static_cast<float>(random() % 400) - 200.0f,
                 y = static_cast<float>(random() % 400) - 200.0f;
      addPatch(&s, material, {x + shift, y + shift, 0.01f * static_cast<float>(i)}, {8.0f, 0.0f, 0.0f},
               {0.0f, 8.0f, 1.0f});
    }
    return s;
  };
  std::vector<image::DepthImage> depths;
  for (const float shift : {0.0f, 32.0f}) {
    render::Renderer renderer(shared(scene(shift)), smallCamera(160, 120, 90.0));
    const Eigen::Vector3d eye(shift, shift, 9.0);
    renderer.look(lookingAt(eye, eye + Eigen::Vector3d(30.0, 12.0, -4.0)));
    depths.push_back(renderer.depth());
  }
  int different = 0;
  for (std::size_t i = 0; i < depths[0].data.size(); ++i) {
    const float a = depths[0].data[i], b = depths[1].data[i];
    // Rounding differs by the shift: 1.5e-5 m at 200 m, seen at a slant.
    if (std::isnan(a) != std::isnan(b) || std::abs(a - b) > 1e-3f * a) ++different;
  }
  EXPECT_LE(different, 20);  // pixels whose centre lies on an edge
}

}  // namespace
}  // namespace sunlit::test
