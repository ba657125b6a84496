#include "light/bake/gather/ground_mirror.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "light/shading/shading.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/scene/scene.h"

namespace sunlit::light {
namespace {

constexpr float kSmoothest = scene::Material::kSmoothest;
constexpr int kAcross = 4;  ///< points of a patch along each of its sides
/// Of what each point stands for, rad: highlights of smooth ground are narrower than their distance.
constexpr float kPointRadius_rad = 0.03f;

using PointsOfPatch = std::array<Eigen::Vector3f, kAcross * kAcross>;

/// Of each patch above the horizon.
struct Points {
  std::array<PointsOfPatch, SkyPatches::kAbove> in;

  Points() {
    for (int patch = 0; patch < SkyPatches::kAbove; ++patch) {
      for (int i = 0; i < kAcross * kAcross; ++i)
        in[static_cast<std::size_t>(patch)][static_cast<std::size_t>(i)] =
            SkyPatches::pointIn(patch, (i % kAcross + 0.5) / kAcross, (i / kAcross + 0.5) / kAcross);
    }
  }
};

/// Mean over a patch by cosine to the zenith, as the patch's own light is.
float mirroredOf(const PointsOfPatch& patch, const Reflection& ground) {
  float sum = 0.0f, weights = 0.0f;
  for (const Eigen::Vector3f& to_light : patch) {
    sum += directReflectance(ground, to_light, kPointRadius_rad)[0];  // black: mirrors alike in all colours
    weights += to_light.z();
  }
  return kPiFloat * sum / weights;
}

}  // namespace

const GroundMirror& GroundMirror::get() {
  // By itself: a thread that waits for the loop within would else take up other work, and may come here.
  static const GroundMirror only = tbb::this_task_arena::isolate([] { return GroundMirror(); });
  return only;
}

GroundMirror::GroundMirror() : rows_(kRoughnesses * SkyPatches::kDown) {
  const SkyPatches patches(1);
  const Points points;
  tbb::parallel_for(std::size_t{0}, rows_.size(), [&](std::size_t i) {
    const SkyPatches::Ray& ray = patches.coarseRays()[SkyPatches::kAbove + i % SkyPatches::kDown];
    Reflection ground;
    ground.normal = Eigen::Vector3f::UnitZ();
    ground.to_eye = -ray.towards;
    ground.albedo.setZero();
    ground.roughness =
        kSmoothest + (1.0f - kSmoothest) * static_cast<float>(i / SkyPatches::kDown) / (kRoughnesses - 1);
    for (std::size_t patch = 0; patch < points.in.size(); ++patch)
      rows_[i][patch] = mirroredOf(points.in[patch], ground);
    rows_[i][SkyPatches::kBelow] = 0.0f;
  });
}

const GroundMirror::Row& GroundMirror::towards(std::size_t down, float roughness) const {
  const float place = (roughness - kSmoothest) / (1.0f - kSmoothest) * (kRoughnesses - 1);
  const auto nearest = static_cast<std::size_t>(std::clamp(place + 0.5f, 0.0f, kRoughnesses - 1.0f));
  return rows_[nearest * SkyPatches::kDown + down];
}

}  // namespace sunlit::light
