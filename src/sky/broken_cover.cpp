#include "broken_cover.h"

#include <algorithm>
#include <cmath>

#include "medium.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::sky {
namespace {

// Optical depths of the tables: kThinnest · 2^i, up to the thickest of any cloud.
constexpr float kThinnest = 0.25F;
constexpr int kSkies = 11;

float depthOf(std::size_t sky) {
  return std::ldexp(kThinnest, static_cast<int>(sky));
}

/// Between which tables an optical depth lies; of thinner ones than the thinnest the first has a share below
/// 1, and the rest is clear.
struct Between {
  std::size_t first;
  float weights[2];
};
Between between(float depth) {
  if (depth <= kThinnest) return {0, {depth / kThinnest, 0.0F}};
  const float at = std::min(std::log2(depth / kThinnest), static_cast<float>(kSkies - 1));
  const std::size_t first = std::min(static_cast<std::size_t>(at), static_cast<std::size_t>(kSkies - 2));
  const float beyond = at - static_cast<float>(first);
  return {first, {1.0F - beyond, beyond}};
}

/// A pixel's width as seen from the camera, rad: what of the cloud is finer is not seen.
constexpr float kFinest_rad = 1.5e-3F;

}  // namespace

BrokenCover::BrokenCover(std::shared_ptr<const CloudMap> map, const CloudPlace& place)
    : map_(std::move(map)), place_(place), shares_(kSkies, 0.0F) {
  constexpr int kParts = 1024;
  for (int i = 0; i < kParts; ++i) {
    const Between at = between(static_cast<float>(map_->depthAt((i + 0.5) / kParts)));
    for (std::size_t k = 0; k < 2; ++k)
      shares_[at.first + k] += at.weights[k] * static_cast<float>(map_->coveredShare() / kParts);
  }
}

void BrokenCover::light(const LightAbove& above, const Droplets& droplets, float albedo_below) {
  std::vector<DropletLayer> layers;
  float clear = 1.0F, thrown_back = 0.0F;
  Eigen::Array3f level = Eigen::Array3f::Zero();
  skies_.clear();
  for (std::size_t i = 0; i < static_cast<std::size_t>(kSkies); ++i) {
    layers.emplace_back(droplets, static_cast<double>(depthOf(i)));
    skies_.emplace_back(layers.back(), above);
    clear -= shares_[i];
    thrown_back += shares_[i] * layers.back().sphericalAlbedo();
    level += shares_[i] * skies_.back().level();
  }
  level += clear * levelOf(above);
  level_ = level / (1.0F - albedo_below * thrown_back);
  for (std::size_t i = 0; i < skies_.size(); ++i)
    skies_[i].addFromBelow(layers[i], level_ * (albedo_below / static_cast<float>(kPi)));
}

BrokenCover::Way BrokenCover::wayUp(const Eigen::Vector3f& towards, const Eigen::Vector3f& from) const {
  // To a shell around the Earth, from somewhat below it: high ground may reach into the cloud.
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
  const float depth = map_->opticalDepth(way.place_m, way.distance_m * kFinest_rad / std::sqrt(way.cosine));
  Seen seen{Eigen::Array3f::Zero(), std::exp(-depth / way.cosine), way.distance_m};
  if (depth <= 0.0F) return seen;
  // As it is seen where the line of sight meets the cloud, which lies lower there.
  Eigen::Vector3f met(towards.x(), towards.y(), 0.0F);
  const float across = met.norm();
  if (across > 0.0F) met *= std::sqrt(std::max(0.0F, 1.0F - way.cosine * way.cosine)) / across;
  met.z() = way.cosine;
  const Between at = between(depth);
  for (std::size_t i = 0; i < 2; ++i) {
    if (at.weights[i] > 0.0F) seen.scattered += at.weights[i] * skies_[at.first + i].scattered(met);
  }
  return seen;
}

float BrokenCover::passed(const Eigen::Vector3f& towards, const Eigen::Vector3f& from) const {
  if (towards.z() <= 0.0F) return meanPassed(0.0F);
  const Way way = wayUp(towards, from);
  // The disc's own width blurs the edge of a shadow.
  const float width_m =
      way.distance_m * static_cast<float>(2.0 * sin(kSunRadiusAtOneAu)) / std::sqrt(way.cosine);
  return std::exp(-map_->opticalDepth(way.place_m, width_m) / way.cosine);
}

float BrokenCover::meanPassed(float z) const {
  const float cosine =
      wayUp({std::sqrt(std::max(0.0F, 1.0F - z * z)), 0.0F, z}, Eigen::Vector3f::Zero()).cosine;
  return static_cast<float>(map_->meanPassed(static_cast<double>(cosine)));
}

}  // namespace sunlit::sky
