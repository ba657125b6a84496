#include "light/bake/samples/bake_veils.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "light/bake/samples/embree_packet.h"

namespace sunlit::light {
namespace {

constexpr float kNone = 1e-3f;  ///< of light: next to nothing

/// One on a ray's way.
struct Veil {
  float distance;      ///< in lengths of the direction
  unsigned primitive;  ///< by Embree's number
  float u, v;
  float share;          ///< of the light that comes through it or from it, what comes from it
  bool stops;           ///< the ray, by chance
  Eigen::Array3f tint;  ///< of what comes through
};

/// Of a ray to the normal of what it meets.
float cosineOf(const RTCFilterFunctionNArguments& at, unsigned i) {
  const Eigen::Vector3f normal(RTCHitN_Ng_x(at.hit, at.N, i), RTCHitN_Ng_y(at.hit, at.N, i),
                               RTCHitN_Ng_z(at.hit, at.N, i));
  const Eigen::Vector3f way(RTCRayN_dir_x(at.ray, at.N, i), RTCRayN_dir_y(at.ray, at.N, i),
                            RTCRayN_dir_z(at.ray, at.N, i));
  return std::abs(normal.normalized().dot(way.normalized()));
}

Veil veilAt(const RTCFilterFunctionNArguments& at, const Cutouts::Query& surface, unsigned i) {
  const float u = RTCHitN_u(at.hit, at.N, i), v = RTCHitN_v(at.hit, at.N, i);
  const float share = surface.share(u, v, cosineOf(at, i));
  return {RTCRayN_tfar(at.ray, at.N, i),
          RTCHitN_primID(at.hit, at.N, i),
          u,
          v,
          share,
          surface.isThere(share, u, v),
          surface.tint()};
}

void stopByChance(const RTCFilterFunctionNArguments* at) {
  eachMasked(*at, [at](const Cutouts::Query& surface, unsigned i) {
    if (!veilAt(*at, surface, i).stops) at->valid[i] = 0;
  });
}

/// In the order of a ray of this reach, which meets each once, though the ray library may tell it twice.
void putInOrder(float reach, std::vector<Veil>* veils) {
  std::sort(veils->begin(), veils->end(), [](const Veil& a, const Veil& b) {
    return std::tie(a.distance, a.primitive) < std::tie(b.distance, b.primitive);
  });
  const auto same = [](const Veil& a, const Veil& b) { return a.primitive == b.primitive; };
  veils->erase(std::unique(veils->begin(), veils->end(), same), veils->end());
  while (!veils->empty() && veils->back().distance > reach) veils->pop_back();
}

}  // namespace

struct BakeVeils::Query {
  RayContext context;  ///< first, so that its address is that of the whole
  std::array<std::vector<Veil>, RayPacket::kSize> met;

  /// Notes veils and lets rays pass those that let light through.
  static void note(const RTCFilterFunctionNArguments* at) {
    auto& query = *reinterpret_cast<Query*>(at->context);
    eachMasked(*at, [&](const Cutouts::Query& surface, unsigned i) {
      const Veil veil = veilAt(*at, surface, i);
      if (veil.share > 1.0f - kNone) return;
      at->valid[i] = 0;
      if (veil.share > kNone) query.met[RTCRayN_id(at->ray, at->N, i)].push_back(veil);
    });
  }
};

BakeVeils::BakeVeils(const Geometry& geometry, MaskedGroup veils, RTCDevice device)
    : veils_(std::move(veils)), scene_(rtcNewScene(device)) {
  for (const std::uint32_t masked : veils_.masked)
    triangles_.push_back(veils_.cutouts->maskedTriangles()[masked]);
  rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
  rtcSetSceneFlags(scene_.get(), kFilterOfQuery);
  const RTCGeometry mesh = triangleMesh(device, geometry, triangles_);
  rtcSetGeometryUserData(mesh, &veils_);
  rtcSetGeometryOccludedFilterFunction(mesh, stopByChance);
  attach(mesh, scene_.get(), 0);
  rtcCommitScene(scene_.get());
}

struct BakeVeils::OfRay {
  int lane;
  const std::vector<Veil>& met;  ///< nearest first
};

void BakeVeils::add(const RayPacket& rays, HitLayers* layers) const {
  RayReach reach;
  for (int i = 0; i < RayPacket::kSize; ++i) {
    if (rays.valid[i] == 0 || layers->ends.triangle[i] == HitPacket::kNothing) continue;
    reach.to[i] = layers->ends.distance[i] + samePlace(rays, i, layers->ends.distance[i]);
  }
  alignas(64) RTCRayHit16 packet = packetOf(rays, reach);
  Query query;
  begin(&query.context);
  intersect(rays.valid, scene_.get(), {Query::note, &query.context}, &packet);
  std::fill_n(layers->through, RayPacket::kSize, 1.0f);
  std::fill_n(layers->through_tints, RayPacket::kSize, PackedTint());
  std::fill_n(layers->stopped_tints, RayPacket::kSize, PackedTint());
  for (int i = 0; i < RayPacket::kSize; ++i) {
    if (rays.valid[i] == 0 || packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    const std::uint32_t triangle = triangles_[packet.hit.primID[i]];
    layers->ends.set(i, {triangle, packet.hit.u[i], packet.hit.v[i], packet.ray.tfar[i]});
  }
  layers->stopped = layers->ends;
  for (int i = 0; i < RayPacket::kSize; ++i) {
    std::vector<Veil>& met = query.met[static_cast<std::size_t>(i)];
    if (rays.valid[i] == 0 || met.empty()) continue;
    putInOrder(packet.ray.tfar[i], &met);
    put({i, met}, layers);
  }
}

void BakeVeils::stop(const int* valid, RTCRay16* rays) const {
  occluded<kIncoherent>(valid, scene_.get(), rays);
}

void BakeVeils::put(const OfRay& ray, HitLayers* layers) const {
  const int i = ray.lane;
  bool stopped = false;
  Eigen::Array3f left = Eigen::Array3f::Ones();
  PackedTint tint;
  for (std::size_t k = 0; k < ray.met.size(); ++k) {
    const Veil& veil = ray.met[k];
    const Hit hit{triangles_[veil.primitive], veil.u, veil.v, veil.distance};
    const auto stop = [&] {
      if (stopped) return;
      layers->stopped.set(i, hit);
      layers->stopped_tints[i] = tint;
      stopped = true;
    };
    if (veil.stops) stop();
    left *= (1.0f - veil.share) * veil.tint;
    const float luminance = LinearRgb(left).luminance();
    if (luminance < kNone) {
      layers->ends.set(i, hit);
      layers->through_tints[i] = tint;
      stop();
      return;
    }
    if (layers->veils.size() == k) layers->veils.push_back(HitLayers::Veil::none());
    layers->veils[k].hits.set(i, hit);
    layers->veils[k].shares[i] = std::max(layers->through[i] - luminance, 0.0f);
    layers->veils[k].tints[i] = tint;
    layers->through[i] = luminance;
    tint = PackedTint(left);
  }
  layers->through_tints[i] = tint;
  if (!stopped) layers->stopped_tints[i] = tint;
}

}  // namespace sunlit::light
