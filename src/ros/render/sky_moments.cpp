#include "ros/render/sky_moments.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "ros/conversions/time.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/turn.h"

namespace sunlit::ros_interface {

namespace {

/// How many moments may wait for their other parts; of more the one that began to arrive first is forgotten.
constexpr std::size_t kMostArriving = 10000;
constexpr std::size_t kMostWhole = 20000;

bool same(const Direction& a, const Direction& b) {
  return a.vector() == b.vector();
}

double between(double a, double b, double share) {
  return a + share * (b - a);
}

Direction between(const Direction& a, const Direction& b, double share) {
  const Eigen::Quaterniond turn = turnBetween(a.vector(), b.vector());
  return Direction(Eigen::Quaterniond::Identity().slerp(share, turn) * a.vector());
}

sky::SunInSky between(const sky::SunInSky& a, const sky::SunInSky& b, double share) {
  return {between(a.apparent, b.apparent, share), between(a.distance_au, b.distance_au, share),
          between(*a.geometric, *b.geometric, share)};
}

sky::MoonInSky between(const sky::MoonInSky& a, const sky::MoonInSky& b, double share) {
  sky::MoonInSky moon = a;
  moon.apparent = between(a.apparent, b.apparent, share);
  moon.geometric = between(*a.geometric, *b.geometric, share);
  moon.distance_m = between(a.distance_m, b.distance_m, share);
  moon.phase_angle = Angle::radians(between(a.phase_angle.rad(), b.phase_angle.rad(), share));
  return moon;
}

/// Whether `b` is what becomes of `a` within `seconds` of ROS time: nobody has set the clock in between, nor
/// the place.
bool runsOn(const SkyBodies& a, const SkyBodies& b, double seconds) {
  constexpr double kTurn_rad_s = 2.0 * kPi / 86164.0;  // of the sky, and more than the sun's own
  constexpr double kRounding_s = 2e-3;                 // civil time is sent in ms
  constexpr double kSmall_rad = 1e-4;
  const double passes_s = a.time.rate * seconds;
  if (a.time.rate != b.time.rate || a.site_elevation_m != b.site_elevation_m) return false;
  if (a.time.utc && b.time.utc &&
      std::abs(b.time.utc->secondsSince(*a.time.utc) - passes_s) > kRounding_s + 1e-6 * std::abs(passes_s))
    return false;
  const double turned_rad =
      std::acos(std::clamp(a.sun->geometric->vector().dot(b.sun->geometric->vector()), -1.0, 1.0));
  return turned_rad <= kTurn_rad_s * std::abs(passes_s) + kSmall_rad;
}

}  // namespace

bool shineAlike(const SkyBodies& a, const SkyBodies& b) {
  const bool same_sun = same(a.sun->apparent, b.sun->apparent) &&
                        same(*a.sun->geometric, *b.sun->geometric) &&
                        a.sun->distance_au == b.sun->distance_au && a.site_elevation_m == b.site_elevation_m;
  if (!same_sun || !a.moon) return same_sun;
  return same(a.moon->apparent, b.moon->apparent) && same(*a.moon->geometric, *b.moon->geometric) &&
         a.moon->distance_m == b.moon->distance_m && a.moon->phase_angle == b.moon->phase_angle &&
         *a.map_from_celestial == *b.map_from_celestial;
}

SkyBodies interpolated(const SkyBodies& a, const SkyBodies& b, double share) {
  SkyBodies sky;
  sky.sun = between(*a.sun, *b.sun, share);
  if (a.moon) {
    sky.moon = between(*a.moon, *b.moon, share);
    const Eigen::Quaterniond from(*a.map_from_celestial), to(*b.map_from_celestial);
    sky.map_from_celestial = from.slerp(share, to).toRotationMatrix();
  }
  sky.site_elevation_m = between(a.site_elevation_m, b.site_elevation_m, share);
  sky.time.rate = a.time.rate;
  if (a.time.utc && b.time.utc)
    sky.time.utc = a.time.utc->plusSeconds(share * b.time.utc->secondsSince(*a.time.utc));
  return sky;
}

template <typename Part>
SkyMoments::Moment& SkyMoments::arrived(Arrival<Part>* topic, const ros::Time& stamp, const Part& value) {
  if (stamp < topic->newest) forget(topic->part);
  topic->newest = stamp;
  auto moment = std::find_if(arriving_.begin(), arriving_.end(),
                             [&](const Moment& other) { return other.stamp == stamp; });
  if (moment == arriving_.end()) moment = arriving_.insert(moment, Moment{stamp, {}});
  moment->bodies.*topic->part = value;
  return *moment;
}

void SkyMoments::put(const ros::Time& stamp, const sky::SunInSky& sun, const SkyTime& time,
                     double site_elevation_m) {
  SkyBodies& bodies = arrived(&sun_, stamp, sun).bodies;
  bodies.time = time;
  bodies.site_elevation_m = site_elevation_m;
  keepIfWhole(stamp);
}

void SkyMoments::put(const ros::Time& stamp, const sky::MoonInSky& moon) {
  arrived(&moon_, stamp, moon);
  keepIfWhole(stamp);
}

void SkyMoments::put(const ros::Time& stamp, const Eigen::Matrix3d& map_from_celestial) {
  arrived(&celestial_, stamp, map_from_celestial);
  keepIfWhole(stamp);
}

template <typename Part>
void SkyMoments::forget(std::optional<Part> SkyBodies::*part) {
  whole_.clear();
  for (Moment& moment : arriving_) (moment.bodies.*part).reset();
  const auto isEmpty = [](const Moment& moment) {
    return !moment.bodies.sun && !moment.bodies.moon && !moment.bodies.map_from_celestial;
  };
  arriving_.erase(std::remove_if(arriving_.begin(), arriving_.end(), isEmpty), arriving_.end());
}

void SkyMoments::keepIfWhole(const ros::Time& stamp) {
  const auto moment = std::find_if(arriving_.begin(), arriving_.end(),
                                   [&](const Moment& other) { return other.stamp == stamp; });
  const SkyBodies& bodies = moment->bodies;
  if (bodies.sun && (!night_ || (bodies.moon && bodies.map_from_celestial))) {
    whole_[stamp] = bodies;
    if (whole_.size() > kMostWhole) thinOut();
    // Those that began to arrive earlier and still lack something are overtaken.
    arriving_.erase(arriving_.begin(), std::next(moment));
  } else if (arriving_.size() > kMostArriving) {
    arriving_.erase(arriving_.begin());
  }
}

void SkyMoments::thinOut() {
  for (auto moment = std::next(whole_.begin()); moment != std::prev(whole_.end());) {
    moment = whole_.erase(moment);
    if (moment != std::prev(whole_.end())) ++moment;
  }
}

std::optional<SkyBodies> SkyMoments::at(const ros::Time& stamp) const {
  const auto after = whole_.lower_bound(stamp);
  if (after != whole_.end() && after->first == stamp) return after->second;
  if (rule_ == SkyRule::kExact) return std::nullopt;
  if (after == whole_.begin()) {
    if (after == whole_.end() || after->second.time.rate != 0.0) return std::nullopt;
    return after->second;
  }
  const auto before = std::prev(after);
  if (before->second.time.rate == 0.0) return before->second;
  if (after == whole_.end()) return std::nullopt;
  const double seconds = secondsFrom(before->first, after->first);
  if (!runsOn(before->second, after->second, seconds)) return before->second;
  const double share = secondsFrom(before->first, stamp) / seconds;
  return interpolated(before->second, after->second, share);
}

bool SkyMoments::missed(const ros::Time& stamp) const {
  return !whole_.empty() && stamp < whole_.rbegin()->first && !at(stamp);
}

double SkyMoments::spacing(const ros::Time& stamp) const {
  const auto after = whole_.lower_bound(stamp);
  if (after == whole_.begin() || after == whole_.end() || after->first == stamp) return 0.0;
  const auto before = std::prev(after);
  return before->second.time.rate == 0.0 ? 0.0 : secondsFrom(before->first, after->first);
}

void SkyMoments::forgetBefore(const ros::Time& stamp) {
  const auto after = whole_.upper_bound(stamp);
  if (after != whole_.begin()) whole_.erase(whole_.begin(), std::prev(after));
}

}  // namespace sunlit::ros_interface
