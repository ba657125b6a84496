#include "sunlit/sky/daylight.h"

#include <algorithm>
#include <utility>

#include "sky_table.h"

namespace sunlit::sky {
namespace {

float heightOf(const Eigen::Vector3f& over_ground) {
  return std::max(over_ground.z(), 0.0F);
}

Sight sight(const Eigen::Vector3f& towards, const Eigen::Vector3f& from) {
  return {towards, from, heightOf(from)};
}

}  // namespace

Daylight::Daylight(std::shared_ptr<const SkyTable> table) : table_(std::move(table)) {}

LinearRgb Daylight::skyLuminance(const Eigen::Vector3f& towards) const {
  return LinearRgb(table_->luminance(sight(towards, from_)));
}

LinearRgb Daylight::skyLuminance(const Eigen::Vector3f& towards, const Eigen::Vector3f& place) const {
  return LinearRgb(table_->luminance(sight(towards, aboveGround(place))));
}

Daylight Daylight::seenFrom(const Eigen::Vector3f& place) const {
  Daylight there = *this;
  there.from_ = aboveGround(place);
  return there;
}

Daylight Daylight::overGround(float level_m) const {
  Daylight there = *this;
  there.ground_m_ = level_m;
  return there;
}

Eigen::Vector3f Daylight::aboveGround(const Eigen::Vector3f& place) const {
  return {place.x(), place.y(), place.z() - ground_m_};
}

Daylight Daylight::withoutAir() const {
  Daylight there = *this;
  there.has_air_ = false;
  return there;
}

float Daylight::throughCloud(const DiscLight& disc, const Eigen::Vector3f& place) const {
  if (!table_->weather) return 1.0F;
  const Eigen::Vector3f towards = disc.towards.vector().cast<float>();
  return table_->weather->passedThere(sight(towards, aboveGround(place)));
}

float Daylight::passedHere(const Eigen::Vector3f& towards) const {
  if (!table_->weather) return 1.0F;
  const Sight here = sight(towards, from_);
  return table_->weather->passedFog(here) * table_->weather->passedThere(here);
}

Rain Daylight::rain() const {
  return table_->weather ? table_->weather->rain() : Rain();
}

Fog Daylight::fog() const {
  return table_->weather && has_air_ ? table_->weather->fog(heightOf(from_)) : Fog();
}

bool Daylight::hasBrokenCloud() const {
  return table_->weather && table_->weather->isBroken();
}

LinearRgb Daylight::skyIlluminance(const Eigen::Vector3f& normal) const {
  return LinearRgb(table_->illuminanceOn(normal));
}

const DiscLight& Daylight::sun() const {
  return table_->sun;
}

const DiscLight& Daylight::moon() const {
  return table_->moon;
}

DiscLight Daylight::sunSeen() const {
  DiscLight sun = table_->sun;
  if (table_->weather)
    sun.illuminance = table_->sun_above_fog * passedHere(sun.towards.vector().cast<float>());
  return sun;
}

DiscLight Daylight::moonSeen() const {
  DiscLight moon = table_->moon;
  if (table_->weather)
    moon.illuminance = table_->moon_above_fog * passedHere(moon.towards.vector().cast<float>());
  return moon;
}

LinearRgb Daylight::starSeen(const PointLight& star) const {
  return star.illuminance * passedHere(star.towards);
}

const std::vector<PointLight>& Daylight::stars() const {
  return table_->stars;
}

AirColumn Daylight::airOver(const Eigen::Vector3f& towards, float distance_m) const {
  if (!has_air_) return {Eigen::Array3f::Ones(), Eigen::Array3f::Zero()};
  return table_->airOver(sight(towards, from_), distance_m);
}

LinearRgb Daylight::groundIlluminance() const {
  return LinearRgb(table_->ground_illuminance);
}

}  // namespace sunlit::sky
