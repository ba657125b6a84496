/// Puts together what belongs to one moment of the sky.
#pragma once

#include <ros/time.h>

#include <map>
#include <optional>

#include "sunlit/sky/atmosphere.h"

namespace sunlit::ros_interface {

/// What is in the sky at one moment. Moon and stars only where there is a night.
struct SkyBodies {
  std::optional<sky::SunInSky> sun;
  std::optional<sky::MoonInSky> moon;
  std::optional<Eigen::Matrix3d> map_from_celestial;
};

/// Sun, moon and stars belong together if they carry the same stamp: moments are never mixed, however late
/// one of the three arrives.
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
  void completed(const ros::Time& stamp);

  bool night_;
  std::map<ros::Time, SkyBodies> arriving_;
  std::optional<SkyBodies> latest_;
  int version_ = 0;
};

}  // namespace sunlit::ros_interface
