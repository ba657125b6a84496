// What a lens keeps for pictures that are divided into rows and exposures.
#include "render/bands.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "render/image_motion.h"
#include "test_scenes.h"

namespace sunlit::test {
namespace {

render::RenderOptions bentCamera() {
  render::RenderOptions options = smallCamera(320, 240);
  options.supersampling = 2;
  options.distortion.coefficients = {-0.28, 0.07, 2e-4, 2e-5, 0.0};
  return options;
}

TEST(Bands, RowsOfALensKnowTheSizeOfPixelsAsTheWholePictureDoes) {
  for (const auto& [model, coefficients] :
       {std::pair(image::LensModel::kPlumbBob, std::vector<double>{-0.28, 0.07, 2e-4, 2e-5, 0.0}),
        std::pair(image::LensModel::kEquidistant, std::vector<double>{0.0, 0.0, 0.0, 0.0})}) {
    render::RenderOptions options = smallCamera(320, 240);
    options.supersampling = 1;
    options.distortion = {model, coefficients};
    const auto canvases = std::make_shared<render::LensCanvases>(options);
    const render::View whole = render::opticsOf(options, canvases.get()).view;
    render::Bands bands(options, canvases);
    for (const render::Band& band : bands.of({16, 1, 0})) {
      const int first = band.first_row;
      const render::View& rows = band.optics.view;
      // Of floats about 1, 3e-3 apart.
      EXPECT_LT((rows.pixelRight() - whole.pixelRight()).norm(), 1e-4 * whole.pixelRight().norm()) << first;
      EXPECT_LT((rows.pixelDown() - whole.pixelDown()).norm(), 1e-4 * whole.pixelDown().norm()) << first;
    }
  }
}

TEST(Bands, ALensKeepsEachRayOnceHoweverItsPictureIsDivided) {
  const render::RenderOptions options = bentCamera();
  const auto canvases = std::make_shared<render::LensCanvases>(options);
  render::Bands bands(options, canvases);
  constexpr std::size_t kPixels = 320 * 240, kBytesOfRay = 12;
  // Three conditions with shutters of their own, at each pose again.
  std::map<int, const std::vector<render::Band>*> first;
  for (int pose = 0; pose < 2; ++pose) {
    for (const int number : {1, 4, 16}) {
      for (int pattern = 1; pattern <= render::kPatterns; ++pattern) {
        const std::vector<render::Band>* const found = &bands.of({number, 1, pattern});
        EXPECT_EQ(found, first.emplace(100 * number + pattern, found).first->second);  // not made again
      }
    }
  }
  EXPECT_EQ(canvases->bytes(), render::kPatterns * kPixels * kBytesOfRay);
  // Four samples a pixel, and its middle.
  render::opticsOf(options, canvases.get());
  EXPECT_EQ(canvases->bytes(), (render::kPatterns + 5) * kPixels * kBytesOfRay);
}

TEST(Bands, ALensKeepsNoMoreThanItMayAndSeesTheSameWithoutIt) {
  const render::RenderOptions options = bentCamera();
  constexpr std::size_t kCanvas = 320 * 240 * 12;
  const auto few = std::make_shared<render::LensCanvases>(options, 2 * kCanvas);
  render::Bands passing(options, few), kept(options, std::make_shared<render::LensCanvases>(options));
  for (int pose = 0; pose < 2; ++pose)
    for (int pattern = 1; pattern <= 4; ++pattern) {
      const render::Division division{4, 1, pattern};
      const auto &a = passing.of(division), &b = kept.of(division);
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].optics.lens->ray(7, 11), b[i].optics.lens->ray(7, 11));
        EXPECT_EQ(a[i].optics.lens->pixels()->widestPixel(), b[i].optics.lens->pixels()->widestPixel());
      }
      EXPECT_LE(few->bytes(), 2 * kCanvas);
    }
  EXPECT_TRUE(few->keep(1, 1) && few->keep(1, 2) && !few->keep(1, 3));
}

TEST(Bands, RowsOfALensSeeByTheBitsOfALensOfTheseRows) {
  for (const int samples : {1, 2}) {
    const render::RenderOptions options = bentCamera();
    render::Bands bands(options, std::make_shared<render::LensCanvases>(options));
    for (const render::Band& band : bands.of({16, samples, 0})) {
      const image::PinholeCamera rows = render::rowsOf(options.camera, band.first_row, band.rows);
      const render::LensCanvas alone(image::Lens(rows, options.distortion), samples);
      for (int y = 0; y < band.rows * samples; ++y)
        for (int x = 0; x < rows.width * samples; ++x)
          ASSERT_EQ(band.optics.lens->ray(x, y), alone.ray(x, y)) << band.first_row << " " << x << " " << y;
      ASSERT_EQ(band.optics.lens->faces().size(), alone.faces().size());
      for (std::size_t f = 0; f < alone.faces().size(); ++f) {
        EXPECT_EQ(band.optics.lens->faces()[f].camera.cx, alone.faces()[f].camera.cx);
        EXPECT_EQ(band.optics.lens->faces()[f].camera.fx, alone.faces()[f].camera.fx);
      }
      EXPECT_EQ(band.optics.lens->pixels()->widestPixel(), alone.pixels()->widestPixel());
      EXPECT_EQ(band.optics.lens->pixels()->at(3.3, -0.4), alone.pixels()->at(3.3, -0.4));
    }
  }
}

TEST(Bands, ARightCameraOfTheSameLensSharesItsRaysAndSeesTheSame) {
  const render::RenderOptions options = bentCamera();
  render::RenderOptions other = options;
  const render::LensCanvases canvases(options);
  EXPECT_TRUE(canvases.areOf(other));
  other.camera.cx += 1.0;
  EXPECT_FALSE(canvases.areOf(other));
  other = options;
  other.distortion.coefficients[0] = -0.2;
  EXPECT_FALSE(canvases.areOf(other));

  render::Renderer left(shared(yard()), options), right(left, options, render::Renderer::States::kAll);
  const light::Illumination light(daylightAt(140.0, 35.0));
  render::UnderWay way;
  way.motion.velocity_m_s = {3.0, 2.0, 0.0};
  way.line_delay_s = 5e-5;
  way.exposure_s = 0.01;
  const auto taken = [&](render::Renderer* renderer) {
    renderer->look(lookingAt({-4.0, -6.0, 1.5}, {4.0, 2.0, 1.0}));
    return renderer->light(light, 0, way).data;
  };
  const std::vector<float> by_left = taken(&left);
  EXPECT_EQ(taken(&right), by_left);
}

}  // namespace
}  // namespace sunlit::test
