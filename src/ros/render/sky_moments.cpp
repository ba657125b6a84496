#include "ros/render/sky_moments.h"

#include <algorithm>
#include <iterator>

namespace sunlit::ros_interface {

namespace {

/// How many moments may wait for their other parts; of more the one that began to arrive first is forgotten.
constexpr std::size_t kMostMoments = 100;

bool same(const Direction& a, const Direction& b) {
  return a.vector() == b.vector();
}

bool same(const SkyBodies& a, const SkyBodies& b) {
  const bool same_sun = same(a.sun->apparent, b.sun->apparent) &&
                        same(*a.sun->geometric, *b.sun->geometric) &&
                        a.sun->distance_au == b.sun->distance_au;
  if (!same_sun || !a.moon) return same_sun;
  return same(a.moon->apparent, b.moon->apparent) && same(*a.moon->geometric, *b.moon->geometric) &&
         a.moon->distance_m == b.moon->distance_m && a.moon->phase_angle == b.moon->phase_angle &&
         *a.map_from_celestial == *b.map_from_celestial;
}

}  // namespace

template <typename Part>
void SkyMoments::put(Arrival<Part>* topic, const ros::Time& stamp, const Part& value) {
  if (stamp < topic->newest) forget(topic->part);
  topic->newest = stamp;
  auto moment = std::find_if(arriving_.begin(), arriving_.end(),
                             [&](const Moment& other) { return other.stamp == stamp; });
  if (moment == arriving_.end()) moment = arriving_.insert(moment, Moment{stamp, {}});
  moment->bodies.*topic->part = value;
  completed(moment);
}

void SkyMoments::put(const ros::Time& stamp, const sky::SunInSky& sun) {
  put(&sun_, stamp, sun);
}

void SkyMoments::put(const ros::Time& stamp, const sky::MoonInSky& moon) {
  put(&moon_, stamp, moon);
}

void SkyMoments::put(const ros::Time& stamp, const Eigen::Matrix3d& map_from_celestial) {
  put(&celestial_, stamp, map_from_celestial);
}

template <typename Part>
void SkyMoments::forget(std::optional<Part> SkyBodies::*part) {
  for (Moment& moment : arriving_) (moment.bodies.*part).reset();
  const auto isEmpty = [](const Moment& moment) {
    return !moment.bodies.sun && !moment.bodies.moon && !moment.bodies.map_from_celestial;
  };
  arriving_.erase(std::remove_if(arriving_.begin(), arriving_.end(), isEmpty), arriving_.end());
}

void SkyMoments::completed(std::vector<Moment>::iterator moment) {
  const SkyBodies& bodies = moment->bodies;
  const bool whole = bodies.sun && (!night_ || (bodies.moon && bodies.map_from_celestial));
  if (whole) {
    if (!latest_ || !same(*latest_, bodies)) {
      latest_ = bodies;
      ++version_;
    }
    // Those that began to arrive earlier and still lack something are overtaken.
    arriving_.erase(arriving_.begin(), std::next(moment));
  } else if (arriving_.size() > kMostMoments) {
    arriving_.erase(arriving_.begin());
  }
}

}  // namespace sunlit::ros_interface
