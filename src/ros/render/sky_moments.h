/// Puts together what belongs to one moment of the sky.
#pragma once

#include <ros/time.h>

#include <optional>
#include <vector>

#include "sunlit/sky/atmosphere.h"

namespace sunlit::ros_interface {

/// What is in the sky at one moment. Moon and stars only where there is a night.
struct SkyBodies {
  std::optional<sky::SunInSky> sun;
  std::optional<sky::MoonInSky> moon;
  std::optional<Eigen::Matrix3d> map_from_celestial;
};

/// Sun, moon and stars belong together if they carry the same stamp: moments are never mixed, however late
/// one of the three arrives. Each of the three comes in the order of its stamps, but for a clock that jumps
/// back: what came before the jump is forgotten.
class SkyMoments {
 public:
  /// Without `night` the sun alone makes a moment.
  explicit SkyMoments(bool night) : night_(night) {}

  void put(const ros::Time& stamp, const sky::SunInSky& sun);
  void put(const ros::Time& stamp, const sky::MoonInSky& moon);
  void put(const ros::Time& stamp, const Eigen::Matrix3d& map_from_celestial);

  /// The moment that became whole last; nothing before the first one did.
  const std::optional<SkyBodies>& latest() const { return latest_; }
  /// Changes whenever anything in latest() moved.
  int version() const { return version_; }

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
  template <typename Part>
  void put(Arrival<Part>* topic, const ros::Time& stamp, const Part& value);
  template <typename Part>
  void forget(std::optional<Part> SkyBodies::*part);
  void completed(std::vector<Moment>::iterator moment);

  bool night_;
  Arrival<sky::SunInSky> sun_{&SkyBodies::sun};
  Arrival<sky::MoonInSky> moon_{&SkyBodies::moon};
  Arrival<Eigen::Matrix3d> celestial_{&SkyBodies::map_from_celestial};
  std::vector<Moment> arriving_;  ///< in the order in which their first parts came
  std::optional<SkyBodies> latest_;
  int version_ = 0;
};

}  // namespace sunlit::ros_interface
