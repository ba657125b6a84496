#include "ros/render/sky_moments.h"

namespace sunlit::ros_interface {

namespace {

/// How many moments may wait for their other parts; of more the oldest is forgotten.
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

void SkyMoments::put(const ros::Time& stamp, const sky::SunInSky& sun) {
  arriving_[stamp].sun = sun;
  completed(stamp);
}

void SkyMoments::put(const ros::Time& stamp, const sky::MoonInSky& moon) {
  arriving_[stamp].moon = moon;
  completed(stamp);
}

void SkyMoments::put(const ros::Time& stamp, const Eigen::Matrix3d& map_from_celestial) {
  arriving_[stamp].map_from_celestial = map_from_celestial;
  completed(stamp);
}

void SkyMoments::completed(const ros::Time& stamp) {
  const auto at = arriving_.find(stamp);
  const SkyBodies& bodies = at->second;
  const bool whole = bodies.sun && (!night_ || (bodies.moon && bodies.map_from_celestial));
  if (whole) {
    if (!latest_ || !same(*latest_, bodies)) {
      latest_ = bodies;
      ++version_;
    }
    // Earlier moments that still lack something are overtaken.
    arriving_.erase(arriving_.begin(), std::next(at));
  } else if (arriving_.size() > kMostMoments) {
    arriving_.erase(arriving_.begin());
  }
}

}  // namespace sunlit::ros_interface
