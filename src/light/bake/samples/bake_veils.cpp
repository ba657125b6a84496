#include "light/bake/samples/bake_veils.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "light/bake/samples/embree_packet.h"

namespace sunlit::light {
namespace {

/// One on a ray's way.
struct Veil {
  float distance;      ///< in lengths of the direction
  unsigned primitive;  ///< by Embree's number
  float u, v;
  float share;  ///< of the light that comes through it or from it, what comes from it

  bool stops() const { return Cutouts::Query::isThere(share, u, v); }
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
  return {RTCRayN_tfar(at.ray, at.N, i), RTCHitN_primID(at.hit, at.N, i), u, v,
          surface.share(u, v, cosineOf(at, i))};
}

void stopByChance(const RTCFilterFunctionNArguments* at) {
  eachMasked(*at, [at](const Cutouts::Query& surface, unsigned i) {
    if (!veilAt(*at, surface, i).stops()) at->valid[i] = 0;
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
    constexpr float kNone = 1e-3f;
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

void BakeVeils::add(const RayPacket& rays, HitLayers* layers) const {
  RayReach reach;
  for (int i = 0; i < RayPacket::kSize; ++i)
    if (layers->ends.triangle[i] != HitPacket::kNothing) reach.to[i] = layers->ends.distance[i];
  alignas(64) RTCRayHit16 packet = packetOf(rays, reach);
  Query query;
  begin(&query.context);
  intersect(rays.valid, scene_.get(), {Query::note, &query.context}, &packet);
  for (int i = 0; i < RayPacket::kSize; ++i) {
    if (rays.valid[i] == 0) continue;
    if (packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) {
      const std::uint32_t triangle = triangles_[packet.hit.primID[i]];
      layers->ends.set(i, {triangle, packet.hit.u[i], packet.hit.v[i], packet.ray.tfar[i]});
    }
    putInOrder(packet.ray.tfar[i], &query.met[static_cast<std::size_t>(i)]);
  }
  put(query, layers);
}

void BakeVeils::stop(const int* valid, RTCRay16* rays) const {
  occluded<kIncoherent>(valid, scene_.get(), rays);
}

void BakeVeils::put(const Query& query, HitLayers* layers) const {
  std::fill_n(layers->through, RayPacket::kSize, 1.0f);
  layers->stopped = layers->ends;
  for (int i = 0; i < RayPacket::kSize; ++i) {
    const std::vector<Veil>& met = query.met[static_cast<std::size_t>(i)];
    bool stopped = false;
    for (std::size_t k = 0; k < met.size(); ++k) {
      const Veil& veil = met[k];
      const Hit hit{triangles_[veil.primitive], veil.u, veil.v, veil.distance};
      if (layers->veils.size() == k) layers->veils.push_back(HitLayers::Veil::none());
      HitLayers::Veil& layer = layers->veils[k];
      layer.hits.set(i, hit);
      layer.shares[i] = layers->through[i] * veil.share;
      layers->through[i] *= 1.0f - veil.share;
      if (stopped || !veil.stops()) continue;
      layers->stopped.set(i, hit);
      stopped = true;
    }
  }
}

}  // namespace sunlit::light
