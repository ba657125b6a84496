/// Which sky belongs to a stamp.
#pragma once

#include <ros/time.h>

#include <map>
#include <optional>
#include <vector>

#include "sunlit/quantity/instant.h"
#include "sunlit/sky/atmosphere.h"

namespace sunlit::ros_interface {

/// What time it is in a sky.
struct SkyTime {
  std::optional<Instant> utc;  ///< where the sun tells it
  double rate = 0.0;           ///< s a second of ROS time; 0: it stands still
};

/// What is in the sky at one moment. Moon and stars only where there is a night.
struct SkyBodies {
  std::optional<sky::SunInSky> sun;
  std::optional<sky::MoonInSky> moon;
  std::optional<Eigen::Matrix3d> map_from_celestial;
  double site_elevation_m = 0.0;  ///< of the place that the sun is seen from
  SkyTime time;
};

/// Whether both light the world alike, to the bit.
bool shineAlike(const SkyBodies& a, const SkyBodies& b);

/// Between two moments, `share` 0 … 1: directions and stars turn about the shortest arc, as in TF; all else
/// goes straight.
SkyBodies interpolated(const SkyBodies& a, const SkyBodies& b, double share);

/// Which stamps have a sky.
enum class SkyRule {
  kExact,   ///< those of the moments alone, so that a sky depends on its stamp and on nothing else
  kAround,  ///< those between two moments too, and all around a moment of a sky that stands still
};

/// Sun, moon and stars belong together if they carry the same stamp: moments are never mixed, however late
/// one of the three arrives. Each of the three comes in the order of its stamps, but for a clock that jumps
/// back: what came before the jump is forgotten.
class SkyMoments {
 public:
  /// Without `night` the sun alone makes a moment.
  explicit SkyMoments(bool night, SkyRule rule = SkyRule::kAround) : night_(night), rule_(rule) {}

  void put(const ros::Time& stamp, const sky::SunInSky& sun, const SkyTime& time = {},
           double site_elevation_m = 0.0);
  void put(const ros::Time& stamp, const sky::MoonInSky& moon);
  void put(const ros::Time& stamp, const Eigen::Matrix3d& map_from_celestial);

  /// The sky of `stamp`: that of the moment of this very stamp; else, by the rule, of a sky that stands still
  /// that of the last moment before it, or of the first after it; of one that moves what is between the two.
  /// A sky that moves is never continued beyond its moments; where its clock or its place was set between the
  /// two it is that of the first until the second, since it never stood in between.
  std::optional<SkyBodies> at(const ros::Time& stamp) const;
  /// Whether at(stamp) has nothing, and no moment that is still to come will change that.
  bool missed(const ros::Time& stamp) const;
  /// s from the moment before `stamp` to that after it, where the sky moves between them; else 0.
  double spacing(const ros::Time& stamp) const;
  /// Nobody will ask for a stamp before this one any more.
  void forgetBefore(const ros::Time& stamp);

  /// The whole moments, oldest first; of more than 20,000 every second one is forgotten.
  const std::map<ros::Time, SkyBodies>& whole() const { return whole_; }

 private:
  struct Moment {
    ros::Time stamp;
    SkyBodies bodies;
  };
  /// One of the three.
  template <typename Part>
  struct Arrival {
    std::optional<Part> SkyBodies::*part;
    ros::Time newest = {};
  };
  /// Where it was put.
  template <typename Part>
  Moment& arrived(Arrival<Part>* topic, const ros::Time& stamp, const Part& value);
  template <typename Part>
  void forget(std::optional<Part> SkyBodies::*part);
  void keepIfWhole(const ros::Time& stamp);
  void thinOut();

  bool night_;
  SkyRule rule_;
  Arrival<sky::SunInSky> sun_{&SkyBodies::sun};
  Arrival<sky::MoonInSky> moon_{&SkyBodies::moon};
  Arrival<Eigen::Matrix3d> celestial_{&SkyBodies::map_from_celestial};
  std::vector<Moment> arriving_;  ///< in the order in which their first parts came
  std::map<ros::Time, SkyBodies> whole_;
};

}  // namespace sunlit::ros_interface
