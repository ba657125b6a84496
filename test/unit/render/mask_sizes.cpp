// Which sizes of a mask a triangle shows, known before its samples are looked at.
#include "render/gl/mask_sizes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "rasterizer_scenes.h"

namespace sunlit::test {
namespace {

constexpr int kTexels = 256;  // a side of the mask

/// A sheet with a mask, put on the screen.
class Sheet {
 public:
  /// From `corner` along `east` and `north`; the mask repeats `times` a side.
  Sheet(const Eigen::Vector3f& corner, const Eigen::Vector3f& east, const Eigen::Vector3f& north,
        float times) {
    scene::Scene scene;
    scene::Texture texture{"leaves", kTexels, kTexels, {}};
    texture.rgba.own().assign(4 * kTexels * kTexels, 255);
    scene.textures.push_back(texture);
    const int leaves = addMaterial(&scene, {0.8f, 0.9f, 0.8f});
    scene.materials[0].base_texture = 0;
    scene.materials[0].alpha_mode = scene::AlphaMode::kMask;
    scene.materials[0].double_sided = true;
    addPatch(&scene, leaves, corner, east, north);
    for (Eigen::Vector2f& at : scene.meshes[0].texture_coordinates) at *= times;
    geometry_ = std::make_shared<const light::Geometry>(shared(std::move(scene)));
    pyramids_ = std::make_unique<render::TexturePyramids>(*geometry_->scene);
  }

  render::ScreenTriangles seenFrom(const render::View& view) const {
    render::ScreenTriangles triangles;
    const render::ScreenProjection projection(view);
    projection.append({*geometry_, 0, static_cast<std::uint32_t>(geometry_->triangles.size()),
                       geometry_->scene->materials[0], 0, pyramids_->of(0)},
                      &triangles);
    return triangles;
  }

 private:
  std::shared_ptr<const light::Geometry> geometry_;
  std::unique_ptr<render::TexturePyramids> pyramids_;
};

/// How many texels lie between a sample and the next to the right or below, by looking a tenth of a sample
/// further.
double texelsBetween(const render::ScreenTriangle& t, const render::MaskPlanes& planes, double column,
                     double row) {
  const auto at = [&](double x, double y) -> Eigen::Vector2d {
    return Eigen::Vector2d(planes.u_per_depth(x, y), planes.v_per_depth(x, y)) * kTexels / t.nearness(x, y);
  };
  constexpr double kStep = 0.05;
  const Eigen::Vector2d right = at(column + kStep, row) - at(column - kStep, row);
  const Eigen::Vector2d down = at(column, row + kStep) - at(column, row - kStep);
  return std::max(right.norm(), down.norm()) / (2.0 * kStep);
}

bool covers(const render::ScreenTriangle& t, int column, int row) {
  for (std::size_t from = 0; from < 3; ++from) {
    const std::size_t to = (from + 1) % 3;
    const double along = t.x[to] - t.x[from], down = t.y[to] - t.y[from];
    if (along * (256.0 * row - t.y[from]) - down * (256.0 * column - t.x[from]) < 0.0) return false;
  }
  return true;
}

TEST(MaskSizes, HoldWhatEverySampleAsksFor) {
  std::minstd_rand random(7);
  const auto uniform = [&random](float least, float greatest) {
    return least +
           (greatest - least) * static_cast<float>(random()) / static_cast<float>(std::minstd_rand::max());
  };
  const auto direction = [&] {
    return Eigen::Vector3f(uniform(-1.0f, 1.0f), uniform(-1.0f, 1.0f), uniform(-1.0f, 1.0f));
  };
  const render::View view = viewFrom(lookingAt({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}), 160, 120, 90.0);
  std::size_t samples = 0, of_one_size = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3f corner(uniform(0.5f, 40.0f), uniform(-10.0f, 10.0f), uniform(-10.0f, 10.0f));
    const float side = uniform(0.2f, 8.0f);
    const Sheet sheet(corner, side * direction(), side * direction(), uniform(0.3f, 4.0f));
    const render::ScreenTriangles seen = sheet.seenFrom(view);
    for (const render::ScreenTriangle& t : seen.triangles) {
      const render::MaskPlanes& planes = seen.masks[static_cast<std::size_t>(t.mask)];
      const render::gl::MaskSizes sizes = render::gl::maskSizesOf(t, planes, 1.0f);
      ASSERT_LE(sizes.largest, sizes.smallest);
      of_one_size += sizes.largest == sizes.smallest;
      for (int row = t.top; row <= t.bottom; ++row) {
        for (int column = t.left; column <= t.right; ++column) {
          if (!covers(t, column, row)) continue;
          const double nearness = t.nearness(column, row);
          if (nearness < t.nearness_least || nearness > t.nearness_greatest)
            continue;  // beside it, by rounding
          const double size = std::log2(texelsBetween(t, planes, column, row));
          // Differences over a tenth of a sample are off by 1e-3 where it turns steepest: 2e-3 of log2.
          EXPECT_GE(size, sizes.largest == 0 ? -HUGE_VAL : sizes.largest - 2e-3)
              << i << ' ' << column << ' ' << row;
          EXPECT_LT(size, sizes.smallest + 1 + 2e-3) << i << ' ' << column << ' ' << row;
          ++samples;
        }
      }
    }
  }
  EXPECT_GT(samples, 50000u);
  EXPECT_GT(of_one_size, 50u);
}

TEST(MaskSizes, AreOneStraightAhead) {
  // 4 m wide at 4 m, 80 pixels and 160 samples a unit of the picture: 160 samples for 256 texels, twice each.
  const render::View view = viewFrom(lookingAt({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}), 160, 120, 90.0);
  const Sheet sheet({4.0f, -2.0f, -1.5f}, {0.0f, 4.0f, 0.0f}, {0.0f, 0.0f, 4.0f}, 2.0f);
  const render::ScreenTriangles seen = sheet.seenFrom(view);
  ASSERT_FALSE(seen.triangles.empty());
  for (const render::ScreenTriangle& t : seen.triangles) {
    const render::MaskPlanes& planes = seen.masks[static_cast<std::size_t>(t.mask)];
    const auto sizesAt = [&](float factor) { return render::gl::maskSizesOf(t, planes, factor); };
    EXPECT_EQ(sizesAt(1.0f).largest, 1);  // 512 texels over 160 samples: 3.2, of the full size every second
    EXPECT_EQ(sizesAt(1.0f).smallest, 1);
    EXPECT_EQ(sizesAt(4.0f).largest, 2);  // 6.4
    EXPECT_EQ(sizesAt(4.0f).smallest, 2);
    EXPECT_EQ(sizesAt(0.01f).smallest, 0);
  }
}

}  // namespace
}  // namespace sunlit::test
