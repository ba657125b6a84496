#include "sunlit/light/lamp_surroundings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "light/geometry/ray_list.h"
#include "light/patches/even_directions.h"

namespace sunlit::light {
namespace {

/// How far a housing may reach, and how much of a lamp's light leaves it at least.
constexpr float kHousing_m = 1.0f, kOpen = 0.1f;
constexpr std::size_t kRays = 256, kMostRays = 16384;

/// Into the lamp's cone.
std::vector<Eigen::Vector3f> directionsOf(const scene::Lamp& lamp) {
  const float cos_outer = std::cos(lamp.outer_rad), share = 0.5f * (1.0f - cos_outer);
  const float all = static_cast<float>(kRays) / std::max(share, 1e-6f);
  std::vector<Eigen::Vector3f> towards = evenDirections(std::min(static_cast<std::size_t>(all), kMostRays));
  const auto isOutside = [&](const Eigen::Vector3f& way) { return way.dot(lamp.direction) < cos_outer; };
  towards.erase(std::remove_if(towards.begin(), towards.end(), isOutside), towards.end());
  if (towards.empty()) towards = {lamp.direction};
  return towards;
}

/// From one lamp into its surroundings.
class LampRays {
 public:
  /// Keeps references.
  LampRays(const World& world, const scene::Lamp& lamp)
      : world_(world), lamp_(lamp), towards_(directionsOf(lamp)) {}

  /// Share of the lamp's directions that nothing stops between `from_m` and kHousing_m.
  float open(float from_m) const {
    RayList rays;
    rays.reserve(towards_.size());
    for (const Eigen::Vector3f& towards : towards_)
      rays.add(0, lamp_.position + from_m * towards, (kHousing_m - from_m) * towards);
    std::vector<std::uint8_t> blocked(rays.size());
    world_.visibility->occludedWithin(rays.rays(), blocked.data());
    return static_cast<float>(std::count(blocked.begin(), blocked.end(), 0)) /
           static_cast<float>(blocked.size());
  }

  /// How near the nearest surface is, if all within the lamp's ball are plain ones; else its radius. What
  /// shines, or is seen through, is part of the lamp.
  float room_m() const {
    RayList rays;
    rays.reserve(towards_.size());
    for (const Eigen::Vector3f& towards : towards_) rays.add(0, lamp_.position, towards);
    std::vector<Hit> hits(rays.size());
    world_.visibility->closest(rays.rays(), hits.data());
    float nearest_m = lamp_.radius_m;
    for (const Hit& hit : hits) {
      if (hit.triangle == Hit::kMiss || hit.distance >= lamp_.radius_m) continue;
      const Geometry& geometry = *world_.geometry;
      const scene::Material& material =
          geometry.scene->materials[static_cast<std::size_t>(geometry.materials[hit.triangle])];
      if (seenThrough(material) || material.emission.value.maxCoeff() > 0.0f) return lamp_.radius_m;
      nearest_m = std::min(nearest_m, hit.distance);
    }
    return nearest_m;
  }

 private:
  const World& world_;
  const scene::Lamp& lamp_;
  std::vector<Eigen::Vector3f> towards_;
};

}  // namespace

std::vector<std::string> fitToSurroundings(const World& world, std::vector<scene::Lamp>* lamps) {
  constexpr float kStep_m = 0.05f, kMore = 0.02f, kOfRoom = 0.5f, kLeast_m = 2e-3f;
  std::vector<std::string> housed;
  for (scene::Lamp& lamp : *lamps) {
    if (!lamp.casts_shadows || lamp.radius_m >= kHousing_m) continue;
    const LampRays around(world, lamp);
    if (around.open(0.0f) >= kOpen) {
      const float room_m = around.room_m();
      if (room_m < lamp.radius_m) lamp.radius_m = std::max(kOfRoom * room_m, kLeast_m);
      continue;
    }
    float from_m = lamp.radius_m, open = around.open(from_m);
    if (open >= kOpen) continue;
    // Up to where another step lets no more light out.
    for (float last = 0.0f; from_m < kHousing_m && (open < kOpen || open - last > kMore);) {
      from_m += kStep_m;
      last = std::exchange(open, around.open(from_m));
    }
    lamp.housing_m = std::min(from_m, kHousing_m);
    housed.push_back(lamp.name);
  }
  return housed;
}

}  // namespace sunlit::light
