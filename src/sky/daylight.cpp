#include "sunlit/sky/daylight.h"

#include <utility>

#include "sky_table.h"

namespace sunlit::sky {

Daylight::Daylight(std::shared_ptr<const SkyTable> table) : table_(std::move(table)) {}

LinearRgb Daylight::skyLuminance(const Eigen::Vector3f& towards) const {
  return LinearRgb(table_->luminance(towards, from_));
}

Daylight Daylight::seenFrom(const Eigen::Vector3f& place) const {
  Daylight there = *this;
  there.from_ = place;
  return there;
}

Daylight Daylight::withoutAir() const {
  Daylight there = *this;
  there.has_air_ = false;
  return there;
}

float Daylight::throughCloud(const DiscLight& disc, const Eigen::Vector3f& place) const {
  return throughCloud(disc.towards.vector().cast<float>(), place);
}

float Daylight::throughCloud(const Eigen::Vector3f& towards, const Eigen::Vector3f& place) const {
  return table_->weather ? table_->weather->passedThere({towards, place}) : 1.0F;
}

Rain Daylight::rain() const {
  return table_->weather ? table_->weather->rain() : Rain();
}

Fog Daylight::fog() const {
  return table_->weather && has_air_ ? table_->weather->fog() : Fog();
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

const std::vector<PointLight>& Daylight::stars() const {
  return table_->stars;
}

AirColumn Daylight::airOver(const Eigen::Vector3f& towards, float distance_m) const {
  if (!has_air_) return {Eigen::Array3f::Ones(), Eigen::Array3f::Zero()};
  return table_->airOver(towards, distance_m);
}

LinearRgb Daylight::groundIlluminance() const {
  return LinearRgb(table_->ground_illuminance);
}

}  // namespace sunlit::sky
