#include "sunlit/light/visibility.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "light/geometry/cutout.h"
#include "light/geometry/embree_fault.h"
#include "light/geometry/triangle_mesh.h"
#include "light/geometry/veil_scene.h"

namespace sunlit::light {
namespace {

/// Marks, while the others are looked at, a ray that has been stopped.
constexpr int kAccepted = 1;

enum GeometryNumber : unsigned { kOpaque = 0, kMasked = 1 };

/// Lets a ray pass where the surface is cut out.
inline __attribute__((always_inline)) void passCutoutsOf(unsigned count,
                                                         const RTCFilterFunctionNArguments* arguments) {
  const auto& cutouts = *static_cast<const Cutouts*>(arguments->geometryUserPtr);
  int* const valid = arguments->valid;
  unsigned i = 0;
  while (i < count && valid[i] != -1) ++i;
  while (i < count) {
    // Rays of a packet mostly meet one triangle.
    const unsigned triangle = RTCHitN_primID(arguments->hit, count, i);
    const Cutouts::Query query(cutouts, triangle);
    for (unsigned next = i; next < count; ++next) {
      if (valid[next] != -1 || RTCHitN_primID(arguments->hit, count, next) != triangle) continue;
      if (!query.solid(RTCHitN_u(arguments->hit, count, next), RTCHitN_v(arguments->hit, count, next)))
        valid[next] = 0;
      else
        valid[next] = kAccepted;
    }
    while (i < count && valid[i] != -1) ++i;
  }
  for (i = 0; i < count; ++i)
    if (valid[i] == kAccepted) valid[i] = -1;
}

void passCutouts(const RTCFilterFunctionNArguments* arguments) {
  constexpr unsigned kMost = 16;  // most packets are full, and where values lie is known then
  if (arguments->N == kMost) return passCutoutsOf(kMost, arguments);
  passCutoutsOf(arguments->N, arguments);
}

/// What a query for the first triangle needs to know, beside Embree's own context (which must come first).
struct SeeingContext {
  RayContext embree;
  const Geometry* geometry;                        ///< null: one-sided triangles are met from both sides
  const std::vector<std::uint32_t>* triangles[2];  ///< by Embree's geometry number: opaque, masked
};

/// Lets a camera's ray pass where there is nothing to see: cut out, or the back of a one-sided triangle.
void passInvisible(const RTCFilterFunctionNArguments* arguments) {
  if (arguments->geometryUserPtr) passCutouts(arguments);
  const auto& context = *reinterpret_cast<const SeeingContext*>(arguments->context);
  if (!context.geometry) return;
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] != -1) continue;
    const std::uint32_t triangle = (*context.triangles[RTCHitN_geomID(
        arguments->hit, arguments->N, i)])[RTCHitN_primID(arguments->hit, arguments->N, i)];
    const scene::Material& material =
        context.geometry->scene->materials[static_cast<std::size_t>(context.geometry->materials[triangle])];
    if (material.alpha_mode == scene::AlphaMode::kBlend) {
      arguments->valid[i] = 0;
      continue;
    }
    if (material.double_sided) continue;
    const Eigen::Vector3f direction(RTCRayN_dir_x(arguments->ray, arguments->N, i),
                                    RTCRayN_dir_y(arguments->ray, arguments->N, i),
                                    RTCRayN_dir_z(arguments->ray, arguments->N, i));
    if (context.geometry->planes[triangle].normal.dot(direction) > 0.0f) arguments->valid[i] = 0;
  }
}

constexpr float kEndless = std::numeric_limits<float>::infinity();

/// `Packet` holds kWidth rays, which reach so many times their direction's length.
template <typename Packet, int kWidth>
void occludedInPackets(RTCScene scene, const Rays& rays, float reach, std::uint8_t* blocked) {
  alignas(64) Packet packet{};  // from 0 on
  alignas(64) int valid[kWidth];
  for (unsigned& mask : packet.mask) mask = ~0u;
  for (std::size_t begin = 0; begin < rays.count; begin += kWidth) {
    const int in_use = static_cast<int>(std::min<std::size_t>(kWidth, rays.count - begin));
    const auto put = [&](const float* values, float* to) {
      values += begin;
      for (int i = 0; i < kWidth; ++i) to[i] = in_use == kWidth ? values[i] : values[std::min(i, in_use - 1)];
    };
    put(rays.origin_x, packet.org_x);
    put(rays.origin_y, packet.org_y);
    put(rays.origin_z, packet.org_z);
    put(rays.direction_x, packet.dir_x);
    put(rays.direction_y, packet.dir_y);
    put(rays.direction_z, packet.dir_z);
    for (int i = 0; i < kWidth; ++i) {
      valid[i] = i < in_use ? -1 : 0;
      packet.tfar[i] = reach;
    }
    light::occluded<kCoherent>(valid, scene, &packet);
    for (int i = 0; i < in_use; ++i) {
      blocked[begin + static_cast<std::size_t>(i)] = packet.tfar[i] < 0.0f ? 1 : 0;  // −∞ marks a hit
    }
  }
}

}  // namespace

class Visibility::Implementation {
 public:
  explicit Implementation(std::shared_ptr<const Geometry> geometry);
  /// Shares the device of `other`.
  Implementation(std::shared_ptr<const Geometry> geometry, const Implementation& other);
  void occluded(const Rays& rays, float reach, Blends blends, std::uint8_t* blocked) const;
  void closest(const Rays& rays, Blends blends, Hit* hits) const;
  Hit firstSeen(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float near) const;
  const VeilScene& veils() const { return *veils_; }
  std::uint32_t triangleCount() const { return static_cast<std::uint32_t>(geometry_->triangles.size()); }

 private:
  void build(RTCBuildQuality quality);
  void attach(const std::vector<std::uint32_t>& triangles, unsigned number);
  void stopped(RTCScene scene, const Rays& rays, float reach, std::uint8_t* blocked) const;
  void buildBlends(RTCBuildQuality quality);

  std::shared_ptr<const Geometry> geometry_;
  Cutouts cutouts_;
  std::optional<Cutouts> blends_;  ///< evenly; empty: nothing does
  DevicePointer device_;
  ScenePointer scene_;        ///< without glass and what blends evenly
  ScenePointer blend_scene_;  ///< of what blends evenly; null: none
  std::unique_ptr<VeilScene> veils_;
  bool wide_ = false;  ///< the CPU takes 16 rays at once
};

Visibility::Implementation::Implementation(std::shared_ptr<const Geometry> geometry)
    : geometry_(std::move(geometry)), cutouts_(*geometry_, Cutouts::Veils::kLeftOut), device_(newDevice()) {
  wide_ = rtcGetDeviceProperty(device_.get(), RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
  build(RTC_BUILD_QUALITY_HIGH);
}

Visibility::Implementation::Implementation(std::shared_ptr<const Geometry> geometry,
                                           const Implementation& other)
    : geometry_(std::move(geometry)),
      cutouts_(*geometry_, Cutouts::Veils::kLeftOut),
      device_(other.device_.get()),
      wide_(other.wide_) {
  rtcRetainDevice(device_.get());
  build(RTC_BUILD_QUALITY_LOW);  // it is for one pose
}

void Visibility::Implementation::build(RTCBuildQuality quality) {
  scene_.reset(rtcNewScene(device_.get()));
  // Without ROBUST, a ray may slip through the edge between two triangles, depending on how the tree was
  // built.
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene_.get(), quality);
  attach(cutouts_.opaqueTriangles(), kOpaque);
  attach(cutouts_.maskedTriangles(), kMasked);
  veils_ = std::make_unique<VeilScene>(*geometry_, device_.get());
  buildBlends(quality);
  rtcCommitScene(scene_.get());
  requireFine(device_.get(), treeOf(geometry_->triangles.size()));
}

void Visibility::Implementation::buildBlends(RTCBuildQuality quality) {
  if (!veils_->hasEvenBlends()) return;
  blends_.emplace(*geometry_, Cutouts::Veils::kEvenOnly);
  blend_scene_.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(blend_scene_.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(blend_scene_.get(), quality);
  const RTCGeometry mesh = triangleMesh(device_.get(), *geometry_, blends_->maskedTriangles());
  rtcSetGeometryUserData(mesh, &*blends_);
  rtcSetGeometryOccludedFilterFunction(mesh, passCutouts);
  rtcSetGeometryIntersectFilterFunction(mesh, passCutouts);
  light::attach(mesh, blend_scene_.get(), 0);
  rtcCommitScene(blend_scene_.get());
}

void Visibility::Implementation::attach(const std::vector<std::uint32_t>& triangles, unsigned number) {
  if (triangles.empty()) return;
  const RTCGeometry mesh = triangleMesh(device_.get(), *geometry_, triangles);
  if (number == kMasked) {
    rtcSetGeometryUserData(mesh, &cutouts_);
    rtcSetGeometryOccludedFilterFunction(mesh, passCutouts);
  }
  rtcSetGeometryIntersectFilterFunction(mesh, passInvisible);
  light::attach(mesh, scene_.get(), number);
}

void Visibility::Implementation::stopped(RTCScene scene, const Rays& rays, float reach,
                                         std::uint8_t* blocked) const {
  if (wide_) {
    occludedInPackets<RTCRay16, 16>(scene, rays, reach, blocked);
  } else {
    occludedInPackets<RTCRay8, 8>(scene, rays, reach, blocked);
  }
}

void Visibility::Implementation::occluded(const Rays& rays, float reach, Blends blends,
                                          std::uint8_t* blocked) const {
  stopped(scene_.get(), rays, reach, blocked);
  if (!blend_scene_ || blends == Blends::kLetPass) return;
  thread_local std::vector<std::uint8_t> by_blends;
  by_blends.resize(rays.count);
  stopped(blend_scene_.get(), rays, reach, by_blends.data());
  for (std::size_t i = 0; i < rays.count; ++i) blocked[i] |= by_blends[i];
}

void Visibility::Implementation::closest(const Rays& rays, Blends blends, Hit* hits) const {
  SeeingContext context{{}, nullptr, {&cutouts_.opaqueTriangles(), &cutouts_.maskedTriangles()}};
  begin(&context.embree);
  for (std::size_t i = 0; i < rays.count; ++i) {
    RTCRayHit query{};
    query.ray.org_x = rays.origin_x[i];
    query.ray.org_y = rays.origin_y[i];
    query.ray.org_z = rays.origin_z[i];
    query.ray.dir_x = rays.direction_x[i];
    query.ray.dir_y = rays.direction_y[i];
    query.ray.dir_z = rays.direction_z[i];
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = ~0u;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    intersect(scene_.get(), &context.embree, &query);
    hits[i] = Hit();
    RTCRayHit blend = query;  // up to what was met
    blend.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    if (blend_scene_ && blends == Blends::kStopByChance)
      intersect(blend_scene_.get(), &context.embree, &blend);
    const bool stopped = blend.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    if (stopped) query = blend;
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
    hits[i].triangle =
        (stopped ? blends_->maskedTriangles() : *context.triangles[query.hit.geomID])[query.hit.primID];
    hits[i].u = query.hit.u;
    hits[i].v = query.hit.v;
    hits[i].distance = query.ray.tfar;
  }
}

Hit Visibility::Implementation::firstSeen(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                                          float near) const {
  SeeingContext context{{}, geometry_.get(), {&cutouts_.opaqueTriangles(), &cutouts_.maskedTriangles()}};
  begin(&context.embree);
  RTCRayHit query{};
  query.ray.org_x = origin.x();
  query.ray.org_y = origin.y();
  query.ray.org_z = origin.z();
  query.ray.dir_x = direction.x();
  query.ray.dir_y = direction.y();
  query.ray.dir_z = direction.z();
  query.ray.tnear = near;
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = ~0u;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  intersect(scene_.get(), &context.embree, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return Hit();
  return {(*context.triangles[query.hit.geomID])[query.hit.primID], query.hit.u, query.hit.v, query.ray.tfar};
}

namespace {

/// The nearer of two hits, the second of which counts its triangles from `first_triangle` on.
Hit nearer(const Hit& fixed, Hit moving, std::uint32_t first_triangle) {
  if (moving.triangle == Hit::kMiss) return fixed;
  if (fixed.triangle != Hit::kMiss && fixed.distance <= moving.distance) return fixed;
  moving.triangle += first_triangle;
  return moving;
}

}  // namespace

Visibility::Visibility(std::shared_ptr<const Geometry> geometry)
    : geometry_(std::move(geometry)), implementation_(std::make_shared<const Implementation>(geometry_)) {}
Visibility::Visibility(std::shared_ptr<const Visibility> fixed, std::shared_ptr<const Geometry> moving)
    : fixed_(std::move(fixed)),
      geometry_(std::move(moving)),
      implementation_(std::make_shared<const Implementation>(geometry_, *fixed_->implementation_)) {}
Visibility::Visibility(const Visibility& other, std::shared_ptr<const Geometry> geometry)
    : geometry_(std::move(geometry)), implementation_(other.implementation_) {}
Visibility::~Visibility() = default;

void Visibility::occluded(const Rays& rays, std::uint8_t* blocked, Blends blends) const {
  occluded(rays, kEndless, blends, blocked);
}

void Visibility::occludedWithin(const Rays& rays, std::uint8_t* blocked, Blends blends) const {
  occluded(rays, 1.0f, blends, blocked);
}

void Visibility::occluded(const Rays& rays, float reach, Blends blends, std::uint8_t* blocked) const {
  implementation_->occluded(rays, reach, blends, blocked);
  if (!fixed_) return;
  thread_local std::vector<std::uint8_t> by_moving;
  by_moving.assign(blocked, blocked + rays.count);
  fixed_->occluded(rays, reach, blends, blocked);
  for (std::size_t i = 0; i < rays.count; ++i) blocked[i] |= by_moving[i];
}

void Visibility::occludedByMoving(const Rays& rays, std::uint8_t* blocked) const {
  if (fixed_) {
    implementation_->occluded(rays, kEndless, Blends::kStopByChance, blocked);
  } else {
    std::fill(blocked, blocked + rays.count, std::uint8_t{0});
  }
}

const Geometry& Visibility::fixedGeometry() const {
  return fixed_ ? *fixed_->geometry_ : *geometry_;
}
const Geometry* Visibility::movingGeometry() const {
  return fixed_ ? geometry_.get() : nullptr;
}

std::uint32_t Visibility::fixedTriangles() const {
  return (fixed_ ? *fixed_ : *this).implementation_->triangleCount();
}

void Visibility::closest(const Rays& rays, Hit* hits, Blends blends) const {
  implementation_->closest(rays, blends, hits);
  if (!fixed_) return;
  const std::vector<Hit> moving(hits, hits + rays.count);
  fixed_->closest(rays, hits, blends);
  for (std::size_t i = 0; i < rays.count; ++i)
    hits[i] = nearer(hits[i], moving[i], fixed_->implementation_->triangleCount());
}

std::optional<std::uint32_t> Visibility::firstSeen(const Eigen::Vector3f& origin,
                                                   const Eigen::Vector3f& direction, float near) const {
  Hit hit = implementation_->firstSeen(origin, direction, near);
  if (fixed_) {
    hit = nearer(fixed_->implementation_->firstSeen(origin, direction, near), hit,
                 fixed_->implementation_->triangleCount());
  }
  if (hit.triangle == Hit::kMiss) return std::nullopt;
  return hit.triangle;
}

void Visibility::veils(const Sight& sight, std::vector<Hit>* hits) const {
  hits->clear();
  if (fixed_) fixed_->implementation_->veils().add(sight, 0, hits);
  implementation_->veils().add(sight, fixed_ ? fixed_->implementation_->triangleCount() : 0, hits);
  if (!fixed_) return;
  std::stable_sort(hits->begin(), hits->end(),
                   [](const Hit& a, const Hit& b) { return a.distance < b.distance; });
  if (hits->size() > kMostVeils) hits->resize(kMostVeils);
}

bool Visibility::hasGlass() const {
  return implementation_->veils().hasGlass() || (fixed_ && fixed_->implementation_->veils().hasGlass());
}

bool Visibility::hasEvenBlends() const {
  return implementation_->veils().hasEvenBlends() ||
         (fixed_ && fixed_->implementation_->veils().hasEvenBlends());
}

bool Visibility::hasDarkVeils() const {
  return implementation_->veils().hasDark() || (fixed_ && fixed_->implementation_->veils().hasDark());
}

bool Visibility::blendsEvenly(const Hit& veil) const {
  const std::uint32_t fixed = fixedTriangles();
  if (veil.triangle >= fixed) return implementation_->veils().blendsEvenly(veil.triangle - fixed);
  return (fixed_ ? *fixed_ : *this).implementation_->veils().blendsEvenly(veil.triangle);
}

bool Visibility::hasVeils() const {
  return implementation_->veils().any() || (fixed_ && fixed_->implementation_->veils().any());
}

}  // namespace sunlit::light
