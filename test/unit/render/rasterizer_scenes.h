/// Pictures of one scene by two rasterizers, side by side.
#pragma once

#include <gtest/gtest.h>

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

/// A scene and two that draw it.
class SideBySide {
 public:
  SideBySide(scene::Scene scene, render::RasterizerKind rasterizer)
      : geometry_(std::make_shared<const light::Geometry>(shared(std::move(scene)))),
        pyramids_(*geometry_->scene),
        tested_(render::makeRasterizer(rasterizer, {geometry_, pyramids_, 0.0})),
        builtin_(render::makeRasterizer(render::RasterizerKind::kBuiltin, {geometry_, pyramids_, 0.0})) {}

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
    if (sample.sky() || sample.triangle > geometry_->materials.size()) return false;
    const auto material = static_cast<std::size_t>(geometry_->materials[sample.triangle - 1]);
    return render::isMasked(geometry_->scene->materials[material]);
  }

  std::shared_ptr<const light::Geometry> geometry_;
  render::TexturePyramids pyramids_;
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

#define SUNLIT_INSTANTIATE_FOR_ALL(suite) \
  INSTANTIATE_TEST_SUITE_P(By, suite, ::testing::ValuesIn(render::builtRasterizers()), rasterizerName)

}  // namespace sunlit::test
