/// Pictures of one scene by two rasterizers, side by side.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/rasterizer.h"
#include "test_scenes.h"

namespace sunlit::test {

/// Where the rasterizer under test disagrees with our own, over some poses.
struct Disagreement {
  std::size_t samples = 0, ids = 0;
  std::size_t masked = 0, masked_by_builtin = 0;  ///< samples that see what is cut out
  double largest_depth = 0.0;                     ///< of equal ids, relative
  double idShare() const { return static_cast<double>(ids) / static_cast<double>(samples); }
  double coverage() const {
    return static_cast<double>(masked) / static_cast<double>(masked_by_builtin) - 1.0;
  }
};

/// A scene as rasterizers take it.
struct Drawable {
  explicit Drawable(scene::Scene scene)
      : geometry(std::make_shared<const light::Geometry>(shared(std::move(scene)))),
        pyramids(*geometry->scene) {}

  std::unique_ptr<render::Rasterizer> by(render::RasterizerKind rasterizer) const {
    return render::makeRasterizer(rasterizer, {geometry, pyramids, 0.0});
  }

  std::shared_ptr<const light::Geometry> geometry;
  render::TexturePyramids pyramids;
};

/// A scene and two that draw it.
class SideBySide {
 public:
  SideBySide(std::shared_ptr<const Drawable> scene, render::RasterizerKind rasterizer)
      : scene_(std::move(scene)),
        tested_(scene_->by(rasterizer)),
        builtin_(scene_->by(render::RasterizerKind::kBuiltin)) {}
  SideBySide(scene::Scene scene, render::RasterizerKind rasterizer)
      : SideBySide(std::make_shared<const Drawable>(std::move(scene)), rasterizer) {}

  /// Adds what differs in the picture of `view`.
  void compare(const render::View& view, Disagreement* sum, const light::Geometry* bodies = nullptr) {
    tested_->draw(view, bodies, &samples_);
    builtin_->draw(view, bodies, &by_builtin_);
    sum->samples += samples_.size();
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const render::Sample &a = samples_[i], &b = by_builtin_[i];
      sum->masked += isMasked(a);
      sum->masked_by_builtin += isMasked(b);
      const double depth = std::abs(static_cast<double>(a.depth) - b.depth) / static_cast<double>(b.depth);
      if (a.triangle == b.triangle) {
        sum->largest_depth = std::max(sum->largest_depth, depth);
      } else {
        ++sum->ids;
      }
    }
  }
  const std::vector<render::Sample>& samples() const { return samples_; }  ///< by the one under test

 private:
  bool isMasked(const render::Sample& sample) const {
    const light::Geometry& geometry = *scene_->geometry;
    if (sample.sky() || sample.triangle > geometry.materials.size()) return false;
    const auto material = static_cast<std::size_t>(geometry.materials[sample.triangle - 1]);
    return render::isMasked(geometry.scene->materials[material]);
  }

  std::shared_ptr<const Drawable> scene_;
  std::unique_ptr<render::Rasterizer> tested_, builtin_;
  std::vector<render::Sample> samples_, by_builtin_;
};

inline render::View viewFrom(const Eigen::Isometry3d& map_from_optical, int width = 640, int height = 480,
                             double fov_deg = 60.0) {
  render::View view;
  view.camera = image::PinholeCamera::fromFieldOfView(width, height, Angle::degrees(fov_deg));
  view.supersampling = 2;
  view.map_from_optical = map_from_optical;
  return view;
}

inline void makeOpaque(scene::Scene* scene) {
  for (scene::Material& material : scene->materials) material.alpha_mode = scene::AlphaMode::kOpaque;
}

/// What each is tested by: of the other rasterizers in this build, those that start here.
class EachRasterizer : public ::testing::TestWithParam<render::RasterizerKind> {
 protected:
  void SetUp() override {
    scene::Scene nothing;
    addGround(&nothing, addMaterial(&nothing, {0.5f, 0.5f, 0.5f}), 1.0f);
    try {
      SideBySide(nothing, GetParam());
    } catch (const std::runtime_error& error) {
      GTEST_SKIP() << error.what();
    }
  }
};

inline std::string rasterizerName(const ::testing::TestParamInfo<render::RasterizerKind>& info) {
  return render::nameOf(info.param);
}

/// Those that there are beside our own, which they are compared with.
inline std::vector<render::RasterizerKind> otherRasterizers() {
  std::vector<render::RasterizerKind> kinds = render::builtRasterizers();
  kinds.erase(std::remove(kinds.begin(), kinds.end(), render::RasterizerKind::kBuiltin), kinds.end());
  return kinds;
}

#define SUNLIT_INSTANTIATE_FOR_ALL(suite) \
  INSTANTIATE_TEST_SUITE_P(By, suite, ::testing::ValuesIn(render::builtRasterizers()), rasterizerName)
#define SUNLIT_INSTANTIATE_FOR_OTHERS(suite) \
  INSTANTIATE_TEST_SUITE_P(By, suite, ::testing::ValuesIn(otherRasterizers()), rasterizerName)

}  // namespace sunlit::test
