/// Rays that leave together, as the ray library takes them.
#pragma once

#include <cstring>

#include "light/bake/samples/ray_packet.h"
#include "light/geometry/embree.h"

namespace sunlit::light {

/// A ray's number is its lane.
inline RTCRayHit16 packetOf(const RayPacket& rays, const RayReach& reach) {
  RTCRayHit16 packet;
  std::memcpy(packet.ray.org_x, rays.origin_x, sizeof(rays.origin_x));
  std::memcpy(packet.ray.org_y, rays.origin_y, sizeof(rays.origin_y));
  std::memcpy(packet.ray.org_z, rays.origin_z, sizeof(rays.origin_z));
  std::memcpy(packet.ray.dir_x, rays.towards_x, sizeof(rays.towards_x));
  std::memcpy(packet.ray.dir_y, rays.towards_y, sizeof(rays.towards_y));
  std::memcpy(packet.ray.dir_z, rays.towards_z, sizeof(rays.towards_z));
  std::memcpy(packet.ray.tnear, reach.from, sizeof(reach.from));
  std::memcpy(packet.ray.tfar, reach.to, sizeof(reach.to));
  for (int i = 0; i < RayPacket::kSize; ++i) {
    packet.ray.time[i] = 0.0f;
    packet.ray.mask[i] = ~0u;
    packet.ray.id[i] = static_cast<unsigned>(i);
    packet.ray.flags[i] = 0;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  return packet;
}

}  // namespace sunlit::light
