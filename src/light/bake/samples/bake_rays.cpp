#include "light/bake/samples/bake_rays.h"

#include <algorithm>
#include <utility>

namespace sunlit::light {

BakeRays::BakeRays(std::shared_ptr<const Geometry> geometry)
    : scene_(std::move(geometry)), covers_(covers(scene_)) {}

void BakeRays::cast(const RayPacket& rays, HitLayers* layers) const {
  scene_.cast(rays, &layers->ends);
  if (!covers_.empty()) preferBacks(rays, &layers->ends);
  scene_.addVeils(rays, layers);
}

void BakeRays::cast(const RayPacket& rays, HitPacket* hits) const {
  HitLayers layers;
  cast(rays, &layers);
  *hits = layers.byChance();
}

void BakeRays::preferBacks(const RayPacket& rays, HitPacket* hits) const {
  RayPacket again = rays;
  RayReach reach;
  bool any = false;
  for (int i = 0; i < RayPacket::kSize; ++i) {
    const std::uint32_t hit = hits->triangle[i];
    const Eigen::Vector3f towards(rays.towards_x[i], rays.towards_y[i], rays.towards_z[i]);
    const bool on_front = rays.valid[i] != 0 && hit != HitPacket::kNothing && covers_[hit] != Cover::kNone &&
                          scene_.geometry().planes[hit].normal.dot(towards) < 0.0f;
    again.valid[i] = on_front ? -1 : 0;
    if (!on_front) continue;
    any = true;
    const float around = samePlace(rays, i, hits->distance[i]);
    reach.from[i] = std::max(hits->distance[i] - around, 0.0f);
    reach.to[i] = hits->distance[i] + around;
  }
  if (!any) return;
  HitPacket backs;
  scene_.castAmong(RayScene::Facing::kAway, again, reach, &backs);
  for (int i = 0; i < RayPacket::kSize; ++i) {
    const std::uint32_t back = backs.triangle[i];
    if (back == HitPacket::kNothing || areSidesOfAWall(covers_[hits->triangle[i]], covers_[back])) continue;
    hits->triangle[i] = back;
    hits->u[i] = backs.u[i];
    hits->v[i] = backs.v[i];
    hits->distance[i] = backs.distance[i];
  }
}

void BakeRays::hide(const std::vector<BakeSight>& sights, std::vector<std::uint8_t>* hidden) const {
  hidden->assign(sights.size(), 0);
  RayPacket packet;
  RayReach reach;
  std::uint8_t found[RayPacket::kSize];
  for (std::size_t first = 0; first < sights.size(); first += RayPacket::kSize) {
    const std::size_t count = std::min<std::size_t>(RayPacket::kSize, sights.size() - first);
    for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
      const BakeSight& sight = sights[first + std::min(i, count - 1)];
      packet.set(i, sight.origin, sight.way, i < count);
      reach.to[i] = std::max(sight.reach, 0.0f);
    }
    scene_.hide(packet, reach, found);
    std::copy_n(found, count, hidden->begin() + static_cast<std::ptrdiff_t>(first));
  }
}

}  // namespace sunlit::light
