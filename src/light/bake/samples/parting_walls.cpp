#include "light/bake/samples/parting_walls.h"

namespace sunlit::light {

bool PartingWalls::operator()(std::uint32_t useless, std::uint32_t other) const {
  constexpr float kWithin_m = 0.05f;  // of the wall that it lies in itself
  constexpr float kAbove_m = 0.03f;   // over bumps of the ground
  const auto above = [&](std::uint32_t sample) {
    const Receiver& receiver = samples_.receivers[sample];
    return Eigen::Vector3f(receiver.origins[0] + kAbove_m * receiver.normal);
  };
  const Eigen::Vector3f from = above(other), way = above(useless) - from;
  const float length_m = way.norm();
  if (!(length_m > kWithin_m)) return false;
  RayPacket packet;
  HitPacket hits;
  const Eigen::Vector3f on = way * (1.0f + kWithin_m / length_m);
  for (std::size_t i = 0; i < RayPacket::kSize; ++i) packet.set(i, from, on, i == 0);
  scene_.rays.cast(packet, &hits);
  const std::uint32_t hit = hits.triangle[0];
  if (hit == HitPacket::kNothing || hits.distance[0] > 1.0f || isLeaf(scene_.traits[hit].kind)) return false;
  // Whoever starts on a wall's face and goes through it meets its other face from within.
  if (scene_.traits[hit].solid && scene_.geometry.planes[hit].normal.dot(way) > 0.0f) return true;
  return hits.distance[0] * (length_m + kWithin_m) < length_m - kWithin_m;
}

}  // namespace sunlit::light
