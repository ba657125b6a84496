// Edges of things, of shadows and of textures, against many more samples.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "test_scenes.h"

namespace sunlit::test {
namespace {

constexpr int kWidth = 96, kHeight = 72;

Eigen::Isometry3d pose() {
  return lookingAt({-4.0, -9.0, 3.0}, {0.3, 1.0, 0.9});
}

/// Seen with `supersampling`², each picture element `finer` times as fine as the one to judge.
image::LinearImage rendered(const scene::Scene& scene, const sky::Daylight& day, int finer,
                            int supersampling) {
  render::RenderOptions options = smallCamera(finer * kWidth, finer * kHeight, 60.0);
  options.supersampling = supersampling;
  render::Renderer renderer(shared(scene), options);
  renderer.look(pose());
  return renderer.light(day);
}

/// Mean over each pixel of those of its 8 × 8 parts whose column and row are among `chosen`.
image::LinearImage meanOfParts(const image::LinearImage& fine, const std::vector<int>& chosen) {
  image::LinearImage mean(kWidth, kHeight);
  const float weight = 1.0f / static_cast<float>(chosen.size() * chosen.size());
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      for (int j : chosen)
        for (int i : chosen)
          for (int c = 0; c < 3; ++c) mean.at(x, y)[c] += weight * fine.at(8 * x + i, 8 * y + j)[c];
    }
  }
  return mean;
}

double rmsDifference(const image::LinearImage& a, const image::LinearImage& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.data.size(); ++i) sum += std::pow(a.data[i] - b.data[i], 2.0);
  return std::sqrt(sum / static_cast<double>(a.data.size()));
}

/// How far the renderer's picture is from the mean of 64 samples a pixel, over how far four of these on a
/// grid are, of which each is looked up, lit and shadowed by itself.
double errorAgainstFourSamples(const scene::Scene& scene, const sky::Daylight& day) {
  const image::LinearImage fine = rendered(scene, day, 8, 1);
  const image::LinearImage truth = meanOfParts(fine, {0, 1, 2, 3, 4, 5, 6, 7});
  return rmsDifference(rendered(scene, day, 1, 2), truth) / rmsDifference(meanOfParts(fine, {2, 5}), truth);
}

/// The share of each pixel's samples from which a ray to the middle of the sun gets through: one a sample.
std::vector<float> sharesByOneRayASample(const scene::Scene& scene, const sky::Daylight& day) {
  const light::World world(shared(scene));
  render::Renderer renderer(world, smallCamera(kWidth, kHeight, 60.0));
  renderer.look(pose());
  const Eigen::Vector3f sun = day.sun().towards.vector().cast<float>();
  std::vector<float> shares(kWidth * kHeight, 0.0f);
  for (const light::Tile& tile : renderer.surfaces().tiles) {
    const std::size_t n = tile.origin_x.size();
    const std::vector<float> x(n, sun.x()), y(n, sun.y()), z(n, sun.z());
    std::vector<std::uint8_t> blocked(n);
    world.visibility->occluded(
        {tile.origin_x.data(), tile.origin_y.data(), tile.origin_z.data(), x.data(), y.data(), z.data(), n},
        blocked.data());
    for (const light::Surface& surface : tile.surfaces) {
      for (std::uint32_t i = 0; i < surface.samples; ++i)
        shares[surface.pixel] += blocked[surface.first_sample + i] ? 0.0f : 0.25f;
    }
  }
  return shares;
}

/// Slanted slats, some thinner than a pixel, over the ground.
scene::Scene slats(bool in_view) {
  scene::Scene scene;
  addGround(&scene, addMaterial(&scene, Eigen::Array3f(0.6f, 0.6f, 0.6f)), 60.0f);
  const int dark = addMaterial(&scene, Eigen::Array3f(0.05f, 0.05f, 0.05f));
  for (int i = 0; i < 24; ++i) {
    const float x = 0.31f * static_cast<float>(i) - 4.0f, width = 0.01f + 0.006f * static_cast<float>(i);
    // Out of view they stand between the sun and what is seen.
    const Eigen::Vector3f foot =
        in_view ? Eigen::Vector3f(x, 0.0f, 0.0f) : Eigen::Vector3f(x - 7.0f, -10.0f, 0.0f);
    addPatch(&scene, dark, foot, {width, 0.02f, 0.0f}, {0.5f, 0.1f, in_view ? 2.0f : 8.0f});
  }
  return scene;
}

TEST(AntiAliasing, OfSilhouettesIsThatOfFourSamples) {
  EXPECT_LT(errorAgainstFourSamples(slats(true), daylightAt(215.0, 89.0)), 1.0);
}

TEST(AntiAliasing, OfShadowEdgesIsThatOfFourSamplesWithARayEach) {
  for (const double elevation_deg : {20.0, 50.0}) {
    const sky::Daylight day = daylightAt(215.0, elevation_deg);
    const scene::Scene shadowed = slats(false);
    scene::Scene lit = shadowed, dark = shadowed;
    lit.meshes.resize(1);
    addPatch(&dark, 0, {-900.0f, -20.0f, 0.0f}, {1800.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 900.0f});
    const image::LinearImage bright = rendered(lit, day, 1, 2), shade = rendered(dark, day, 1, 2);
    image::LinearImage four(kWidth, kHeight);
    const std::vector<float> shares = sharesByOneRayASample(shadowed, day);
    for (std::size_t i = 0; i < four.data.size(); ++i)
      four.data[i] = shade.data[i] + shares[i / 3] * (bright.data[i] - shade.data[i]);
    const image::LinearImage truth = meanOfParts(rendered(shadowed, day, 8, 1), {0, 1, 2, 3, 4, 5, 6, 7});
    const double error = rmsDifference(rendered(shadowed, day, 1, 2), truth);
    EXPECT_LT(error, rmsDifference(four, truth)) << elevation_deg;
    EXPECT_GT(error, 0.0);
  }
}

TEST(AntiAliasing, OfTexturesIsThatOfFourSamples) {
  scene::Scene scene;
  scene::Texture checks{"checks", 64, 64, {}};
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const auto code = static_cast<std::uint8_t>((x / 8 + y / 8) % 2 == 0 ? 230 : 40);
      checks.rgba.own().insert(checks.rgba.own().end(), {code, code, code, 255});
    }
  }
  scene.textures.push_back(checks);
  const int material = addMaterial(&scene, Eigen::Array3f::Ones());
  scene.materials[0].base_texture = 0;
  // From checks of many pixels in front to checks of less than one behind.
  for (int i = -6; i < 6; ++i) {
    for (int k = -3; k < 20; ++k)
      addPatch(&scene, material, {4.0f * static_cast<float>(i), 4.0f * static_cast<float>(k), 0.0f},
               {4.0f, 0.0f, 0.0f}, {0.0f, 4.0f, 0.0f});
  }
  EXPECT_LT(errorAgainstFourSamples(scene, daylightAt(215.0, 45.0)), 1.0);
}

}  // namespace
}  // namespace sunlit::test
