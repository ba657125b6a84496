// Fractal detail has the contrast that the material asks for, stands still in `map`, and fades with distance.
#include <gtest/gtest.h>

#include <cmath>

#include "test_scenes.h"

namespace sunlit::test {
namespace {

struct Albedos {
  double mean = 0.0, deviation = 0.0;
};

scene::Scene detailedGround(float contrast, float coarsest_m, float finest_m) {
  scene::Scene scene;
  addGround(&scene, addMaterial(&scene, {0.4f, 0.4f, 0.4f}), 5000.0f);
  scene.materials[0].detail.contrast = contrast;
  scene.materials[0].detail.coarsest_m = coarsest_m;
  scene.materials[0].detail.finest_m = finest_m;
  return scene;
}

/// Straight down from `height` m on 1 m a pixel times height / 100.
image::LinearImage fromAbove(const scene::Scene& scene, const Eigen::Vector3d& eye, int supersampling = 1) {
  render::RenderOptions options;
  options.camera = image::PinholeCamera{256, 256, 25600.0, 25600.0, 127.5, 127.5};  // rays nearly parallel
  options.supersampling = supersampling;
  render::Renderer renderer(shared(scene), options);
  renderer.look(lookingAt(eye, {eye.x(), eye.y(), 0.0}));
  return renderer.light(daylightAt(180.0, 60.0));
}

Albedos relative(const image::LinearImage& image) {
  double sum = 0.0, squares = 0.0;
  const double n = static_cast<double>(image.data.size()) / 3.0;
  for (std::size_t i = 1; i < image.data.size(); i += 3) {
    sum += image.data[i];
    squares += static_cast<double>(image.data[i]) * image.data[i];
  }
  const double mean = sum / n;
  return {mean, std::sqrt(squares / n - mean * mean) / mean};
}

TEST(Detail, HasTheContrastThatTheMaterialAsksFor) {
  // 2.56 m of ground, 1 cm a pixel; octaves of 32, 16 and 8 cm, all well above a pixel.
  const Albedos plain = relative(fromAbove(detailedGround(0.0f, 0.32f, 0.08f), {700.0, -300.0, 256.0}));
  const Albedos detailed = relative(fromAbove(detailedGround(0.15f, 0.32f, 0.08f), {700.0, -300.0, 256.0}));
  EXPECT_LT(plain.deviation, 0.002);  // nothing but rounding of the albedo
  // 64 cells of the coarsest octave: their mean wanders by an eighth of their deviation. The mirror part of
  // the light does not vary and takes 1 % away.
  EXPECT_NEAR(detailed.deviation, 0.15, 0.02);
  EXPECT_NEAR(detailed.mean, plain.mean, 0.03 * plain.mean);
}

TEST(Detail, StandsStillInTheMapWhenTheCameraMoves) {
  const scene::Scene scene = detailedGround(0.3f, 0.64f, 0.08f);
  const image::LinearImage here = fromAbove(scene, {3000.0, -2000.0, 256.0});
  const image::LinearImage there = fromAbove(scene, {3000.10, -2000.0, 256.0});  // 10 px to the right
  double worst = 0.0;
  for (int y = 0; y < 256; ++y) {
    for (int x = 10; x < 256; ++x)
      worst = std::max(worst, std::abs(1.0 - at(there, x - 10, y)[1] / at(here, x, y)[1]));
  }
  // Single precision of a place 2 km off moves the finest octave, 8 cm, by 1/600 of its wavelength at most.
  EXPECT_LT(worst, 0.02);
}

TEST(Detail, FinerThanAPixelFadesToItsMean) {
  const scene::Scene scene = detailedGround(0.3f, 0.04f, 0.01f);
  const Albedos far = relative(fromAbove(scene, {0.0, 0.0, 2560.0}));  // 10 cm a pixel
  EXPECT_LT(far.deviation, 0.002);
}

TEST(Detail, OfAPixelIsTheMeanOverItsSamples) {
  // Octaves of 32, 16 and 8 px of 1 cm, then of 4 and 2 px.
  for (const float coarsest_m : {0.32f, 0.04f}) {
    const scene::Scene scene = detailedGround(0.15f, coarsest_m, coarsest_m / 4.0f);
    // Four samples a pixel of 2 cm cover the same places as four pixels of 1 cm with a sample each.
    const image::LinearImage fine = fromAbove(scene, {0.0, 0.0, 256.0}, 1);
    const image::LinearImage coarse = fromAbove(scene, {0.0, 0.0, 512.0}, 2);
    double difference = 0.0, deviation = 0.0;
    const double mean = relative(fine).mean;
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 128; ++x) {
        const double four = (at(fine, 2 * x, 2 * y)[1] + at(fine, 2 * x + 1, 2 * y)[1] +
                             at(fine, 2 * x, 2 * y + 1)[1] + at(fine, 2 * x + 1, 2 * y + 1)[1]) /
                            4.0;
        difference += std::pow(at(coarse, x + 64, y + 64)[1] - four, 2.0);
        deviation += std::pow(four - mean, 2.0);
      }
    }
    // The mean is taken by one look at the middle of the pixel, which tells waves of four samples or less
    // only roughly.
    EXPECT_LT(std::sqrt(difference / deviation), coarsest_m > 0.1f ? 0.1 : 0.4) << coarsest_m;
  }
}

TEST(Detail, DoesNotRepeat) {
  // Places a power of two apart, where a hash or table of limited period would show the same.
  const scene::Scene scene = detailedGround(0.3f, 0.64f, 0.08f);
  const image::LinearImage here = fromAbove(scene, {0.0, 0.0, 256.0});
  for (const double step : {163.84, 655.36, 1310.72}) {  // 256, 1024 and 2048 cells of the coarsest octave
    const image::LinearImage there = fromAbove(scene, {step, 0.0, 256.0});
    const double mean_here = relative(here).mean, mean_there = relative(there).mean;
    double product = 0.0, a2 = 0.0, b2 = 0.0;
    for (std::size_t i = 1; i < here.data.size(); i += 3) {
      const double a = here.data[i] - mean_here, b = there.data[i] - mean_there;
      product += a * b;
      a2 += a * a;
      b2 += b * b;
    }
    // Some 50 independent cells: chance correlations of 0.15.
    EXPECT_LT(std::abs(product / std::sqrt(a2 * b2)), 0.5) << step;
  }
}

}  // namespace
}  // namespace sunlit::test
