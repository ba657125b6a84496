#include "light/picture/bodies/lamps_on_places.h"

#include <algorithm>

#include "light/geometry/ray_list.h"

namespace sunlit::light {
namespace {

constexpr float kLeftOut = 0.01f;
/// How far before the lamp's ball a ray ends.
constexpr float kClear_m = 1e-3f;

/// Coordinates side by side, as beams take them.
struct Columns {
  explicit Columns(const std::vector<LitPlace>& places) {
    for (const LitPlace& place : places) {
      x.push_back(place.origin.x());
      y.push_back(place.origin.y());
      z.push_back(place.origin.z());
    }
  }
  LampBeam::Points points() const { return {x.data(), y.data(), z.data(), x.size()}; }
  std::vector<float> x, y, z;
};

}  // namespace

void addLampLight(const LampsOnPlaces& from, const std::vector<LitPlace>& places,
                  std::vector<Eigen::Array3f>* illuminance) {
  const auto& [lamps, visibility] = from;
  const Columns columns(places);
  std::vector<float> shares(places.size()), least_lx;
  least_lx.reserve(places.size());
  for (const Eigen::Array3f& lx : *illuminance) least_lx.push_back(lx.maxCoeff());
  for (const LampBeam& lamp : lamps) {
    lamp.shares(columns.points(), shares.data());
    for (std::size_t i = 0; i < places.size(); ++i) least_lx[i] += shares[i] * lamp.brightest();
  }
  for (float& lx : least_lx) lx *= kLeftOut / static_cast<float>(std::max<std::size_t>(lamps.size(), 1));
  RayList rays;
  std::vector<std::uint8_t> blocked;
  for (const LampBeam& lamp : lamps) {
    lamp.shares(columns.points(), shares.data());
    rays.clear();
    rays.reserve(places.size());
    for (std::uint32_t i = 0; i < places.size(); ++i) {
      if (!(shares[i] * lamp.brightest() > least_lx[i])) continue;
      if (!(places[i].normal.dot(lamp.towards(places[i].origin)) > 0.0f)) continue;
      const Eigen::Vector3f way = lamp.ball() - places[i].origin;
      const float reach = 1.0f - (lamp.spared_m() + kClear_m) / std::max(way.norm(), 1e-6f);
      rays.add(i, places[i].origin, std::max(reach, 1e-6f) * way);
    }
    blocked.assign(rays.size(), 0);
    if (lamp.castsShadows()) visibility.occludedWithin(rays.rays(), blocked.data());
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const std::uint32_t i = rays.number()[k];
      if (blocked[k] != 0) continue;
      const float cosine = places[i].normal.dot(lamp.towards(places[i].origin));
      (*illuminance)[i] += cosine * shares[i] * lamp.intensity();
    }
  }
}

}  // namespace sunlit::light
