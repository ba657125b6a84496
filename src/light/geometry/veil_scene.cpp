#include "light/geometry/veil_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "light/geometry/cutout.h"
#include "light/geometry/embree.h"

namespace sunlit::light {
namespace {

/// By far more than rounding makes of what a ray meets 10 km away: how much larger boxes are, and rays
/// longer.
constexpr float kClear_m = 0.01f, kClear = 1e-5f, kLonger = 1.0f + 1e-5f;

Eigen::AlignedBox3f boxOf(const Geometry& geometry, const std::vector<std::uint32_t>& triangles) {
  Eigen::AlignedBox3f box;
  for (const std::uint32_t triangle : triangles)
    for (const std::uint32_t corner : geometry.triangles[triangle]) box.extend(geometry.positions[corner]);
  const float largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  const Eigen::Vector3f clear = Eigen::Vector3f::Constant(kClear_m + kClear * largest);
  return {box.min() - clear, box.max() + clear};
}

/// False where `sight` misses `box` for sure.
bool mayMeet(const Eigen::AlignedBox3f& box, const Visibility::Sight& sight) {
  float near = sight.near, far = sight.far;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const float per_direction = 1.0f / sight.direction[axis];
    const float a = (box.min()[axis] - sight.origin[axis]) * per_direction;
    const float b = (box.max()[axis] - sight.origin[axis]) * per_direction;
    // Of a sight along the planes of a face both are infinite.
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b) * kLonger);
  }
  return near <= far;
}

/// Whether a veil takes so much of the light that pixels at the edge of a patch of it show whose rays were
/// asked.
bool isDark(const scene::Material& material, bool blends_evenly) {
  constexpr float kDim = 0.8f;
  if (isGlass(material)) return material.glass * material.base_color.value.minCoeff() < kDim;
  return blends_evenly && 1.0f - material.alpha < kDim;
}

}  // namespace

VeilScene::VeilScene(const Geometry& geometry, RTCDevice device) : geometry_(geometry) {
  const std::vector<scene::Material>& materials = geometry.scene->materials;
  std::vector<bool> used(materials.size(), false);
  for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
    const auto material = static_cast<std::size_t>(geometry.materials[t]);
    if (seenThrough(materials[material])) triangles_.push_back(t);
    used[material] = true;
  }
  even_.resize(materials.size());
  for (std::size_t m = 0; m < materials.size(); ++m) {
    if (!used[m]) continue;
    even_[m] = light::blendsEvenly(*geometry.scene, materials[m]);
    has_even_ = has_even_ || even_[m];
    has_glass_ = has_glass_ || isGlass(materials[m]);
    has_dark_ = has_dark_ || isDark(materials[m], even_[m]);
  }
  if (triangles_.empty()) return;
  box_ = boxOf(geometry, triangles_);
  scene_.reset(rtcNewScene(device));
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  attach(triangleMesh(device, geometry, triangles_), scene_.get(), 0);
  rtcCommitScene(scene_.get());
}

/// One after the other: each query begins just beyond the hit before.
void VeilScene::add(const Visibility::Sight& sight, std::uint32_t first_triangle,
                    std::vector<Hit>* hits) const {
  // From most places most rays meet none, which a box tells sooner than the ray library.
  if (!scene_ || !mayMeet(box_, sight)) return;
  RayContext context;
  begin(&context);
  float near = sight.near;
  for (std::size_t count = 0; count < Visibility::kMostVeils && near < sight.far;) {
    RTCRayHit query{};
    query.ray.org_x = sight.origin.x();
    query.ray.org_y = sight.origin.y();
    query.ray.org_z = sight.origin.z();
    query.ray.dir_x = sight.direction.x();
    query.ray.dir_y = sight.direction.y();
    query.ray.dir_z = sight.direction.z();
    query.ray.tnear = near;
    query.ray.tfar = sight.far;
    query.ray.mask = ~0u;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    intersect(scene_.get(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return;
    near = std::nextafter(query.ray.tfar * (1.0f + 1e-6f), std::numeric_limits<float>::infinity());
    const std::uint32_t triangle = triangles_[query.hit.primID];
    const auto material = static_cast<std::size_t>(geometry_.materials[triangle]);
    const bool back = geometry_.planes[triangle].normal.dot(sight.direction) > 0.0f;
    if (back && !sight.backs && !geometry_.scene->materials[material].double_sided) continue;
    hits->push_back({first_triangle + triangle, query.hit.u, query.hit.v, query.ray.tfar});
    ++count;
  }
}

}  // namespace sunlit::light
