#include "broken_cover.h"

#include <algorithm>
#include <cmath>

#include "medium.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::sky {
namespace {

// Optical depths of the tables: kThinnest · 2^i.
constexpr float kThinnest = 0.25F;

float depthOf(std::size_t sky) {
  return std::ldexp(kThinnest, static_cast<int>(sky));
}

/// As many as reach the thickest cloud; two at least.
std::size_t skiesUpTo(double thickest) {
  return static_cast<std::size_t>(
             std::ceil(std::max(1.0, std::log2(thickest / static_cast<double>(kThinnest))))) +
         1;
}

/// Between which of so many tables an optical depth lies; of thinner ones than the thinnest the first has a
/// share below 1, and the rest is clear.
struct Between {
  std::size_t first;
  float weights[2];
};
Between between(float depth, std::size_t skies) {
  if (depth <= kThinnest) return {0, {depth / kThinnest, 0.0F}};
  const float at = std::min(std::log2(depth / kThinnest), static_cast<float>(skies - 1));
  const std::size_t first = std::min(static_cast<std::size_t>(at), skies - 2);
  const float beyond = at - static_cast<float>(first);
  return {first, {1.0F - beyond, beyond}};
}

/// Of all places, those of about the optical depth of each table.
std::vector<float> sharesOf(const CloudMap& map, std::size_t skies) {
  std::vector<float> shares(skies, 0.0F);
  constexpr int kParts = 1024;
  for (int i = 0; i < kParts; ++i) {
    const Between at = between(static_cast<float>(map.depthAt((i + 0.5) / kParts)), skies);
    for (std::size_t k = 0; k < 2; ++k)
      shares[at.first + k] += at.weights[k] * static_cast<float>(map.coveredShare() / kParts);
  }
  return shares;
}

/// A pixel's width as seen from the camera, rad: what of the cloud is finer is not seen.
constexpr float kFinest_rad = 1.5e-3F;

}  // namespace

BrokenCover::BrokenCover(const CloudPlace& place, const LightAbove& above, const Droplets& droplets,
                         float albedo_below)
    : place_(place) {
  const std::vector<float> shares = sharesOf(*place_.map, skiesUpTo(place_.map->depthAt(1.0)));
  std::vector<DropletLayer> layers;
  float clear = 1.0F, thrown_back = 0.0F;
  Eigen::Array3f level = Eigen::Array3f::Zero();
  for (std::size_t i = 0; i < shares.size(); ++i) {
    layers.emplace_back(droplets, static_cast<double>(depthOf(i)));
    skies_.emplace_back(layers.back(), above);
    clear -= shares[i];
    thrown_back += shares[i] * layers.back().sphericalAlbedo();
    level += shares[i] * skies_.back().level();
  }
  level += clear * levelOf(above);
  level_ = level / (1.0F - albedo_below * thrown_back);
  for (std::size_t i = 0; i < skies_.size(); ++i)
    skies_[i].addFromBelow(layers[i], level_ * (albedo_below / static_cast<float>(kPi)));
  for (const DiscLight& disc : above.discs) {
    const Eigen::Vector3f towards = disc.towards.vector().cast<float>();
    if (disc.illuminance.value.maxCoeff() <= 0.0F) continue;
    const float cosine = wayUp(towards, Eigen::Vector3f::Zero()).cosine;
    shadows_.push_back(
        {towards.z(), meanPassed(towards.z()), place_.map->passed(static_cast<double>(cosine))});
  }
}

BrokenCover::Way BrokenCover::wayUp(const Eigen::Vector3f& towards, const Eigen::Vector3f& from) const {
  // To a shell around the Earth, from below it: an eye on high ground or in the air, at the cloud or above
  // it, has it 50 m above itself, too.
  const double height_m = std::max(place_.base_m - static_cast<double>(from.z()), 50.0);
  const double radius_m = kEarthRadius_km * 1e3;
  const double z = std::max(static_cast<double>(towards.z()), 0.0);
  const double along = radius_m * z;
  const double distance_m = std::sqrt(along * along + height_m * (2.0 * radius_m + height_m)) - along;
  const double level = radius_m / (radius_m + height_m);
  const double cosine = std::sqrt(std::max(0.0, 1.0 - level * level * (1.0 - z * z)));
  const Eigen::Vector2d place_m =
      (from.head<2>().cast<double>() + towards.head<2>().cast<double>() * distance_m) - place_.drift_m;
  return {place_m, static_cast<float>(cosine), static_cast<float>(distance_m)};
}

BrokenCover::Seen BrokenCover::seen(const Eigen::Vector3f& towards, const Eigen::Vector3f& from) const {
  const Way way = wayUp(towards, from);
  const float depth =
      place_.map->opticalDepth(way.place_m, way.distance_m * kFinest_rad / std::sqrt(way.cosine));
  Seen seen{Eigen::Array3f::Zero(), std::exp(-depth / way.cosine), way.distance_m};
  if (depth <= 0.0F) return seen;
  // As it is seen where the line of sight meets the cloud, which lies lower there.
  Eigen::Vector3f met(towards.x(), towards.y(), 0.0F);
  const float across = met.norm();
  if (across > 0.0F) met *= std::sqrt(std::max(0.0F, 1.0F - way.cosine * way.cosine)) / across;
  met.z() = way.cosine;
  const Between at = between(depth, skies_.size());
  const LayerSky::Place towards_it = LayerSky::placeOf(met);
  for (std::size_t i = 0; i < 2; ++i) {
    if (at.weights[i] > 0.0F) seen.scattered += at.weights[i] * skies_[at.first + i].scattered(towards_it);
  }
  return seen;
}

float BrokenCover::passed(const Eigen::Vector3f& towards, const Eigen::Vector3f& from) const {
  const Way way = wayUp(towards, from);
  for (const Shadows& shadows : shadows_) {
    if (shadows.z != towards.z()) continue;
    // Between cells of half the disc's width lies as much around a place as there is of the disc: both
    // spread by a quarter of that width.
    const float width_m = way.distance_m * static_cast<float>(sin(kSunRadiusAtOneAu)) / std::sqrt(way.cosine);
    return shadows.passed.around(way.place_m, width_m);
  }
  return std::exp(-place_.map->opticalDepth(way.place_m, 0.0F) / way.cosine);
}

float BrokenCover::meanPassed(float z) const {
  for (const Shadows& shadows : shadows_) {
    if (shadows.z == z) return shadows.mean;
  }
  const float cosine =
      wayUp({std::sqrt(std::max(0.0F, 1.0F - z * z)), 0.0F, z}, Eigen::Vector3f::Zero()).cosine;
  return static_cast<float>(place_.map->meanPassed(static_cast<double>(cosine)));
}

}  // namespace sunlit::sky
