#include "sunlit/studio/other_site.h"

#include <Eigen/Geometry>
#include <cmath>

#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/range.h"

namespace sunlit::studio {
namespace {

/// 2 km: a sun that nobody sees to stand elsewhere, twice what two decimals leave out and more than the
/// Earth's turn is uncertain by.
constexpr double kSame_deg = 0.02;
constexpr double kSame_m = 100.0;  ///< 1 % of the air above

bool isSameHeight(const scene::WorldSite& world, double elevation_m) {
  return std::abs(world.site.elevation_m - elevation_m) <= kSame_m;
}

Eigen::Quaterniond turnOf(const Site& site) {
  return Eigen::AngleAxisd(site.longitude.rad(), Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(-site.latitude.rad(), Eigen::Vector3d::UnitY());
}

bool isSame(double apart_rad) {
  return apart_rad <= kSame_deg * kRadPerDeg;
}

}  // namespace

bool isSiteOf(const scene::WorldSite& world, const Site& site) {
  return isSame(turnOf(world.site).angularDistance(turnOf(site))) && isSameHeight(world, site.elevation_m);
}

bool isSkyOver(const scene::WorldSite& world, const SkyBodies& bodies, const Instant& instant) {
  if (!isSameHeight(world, bodies.site_elevation_m)) return false;
  const SkyBodies there = bodiesAt(instant, world.site);
  if (bodies.map_from_celestial)
    return isSame(Eigen::Quaterniond(*bodies.map_from_celestial)
                      .angularDistance(Eigen::Quaterniond(*there.map_from_celestial)));
  const auto towards = [](const sky::SunInSky& sun) { return sun.geometric.value_or(sun.apparent).vector(); };
  const Eigen::Vector3d seen = towards(bodies.sun), expected = towards(there.sun);
  return isSame(std::atan2(seen.cross(expected).norm(), seen.dot(expected)));
}

std::string otherSiteText(const scene::WorldSite& world) {
  const auto site = [&](const std::string& comma) {
    return textOf(world.site.latitude.deg()) + comma + textOf(world.site.longitude.deg()) + comma +
           textOf(world.site.elevation_m);
  };
  return world.place + ": the sun is of another site than these <spherical_coordinates>: --site " +
         site(",") + ", of launch files site:=\"[" + site(", ") + "]\"";
}

}  // namespace sunlit::studio
