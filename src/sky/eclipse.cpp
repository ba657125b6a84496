#include "sunlit/sky/eclipse.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "medium.h"
#include "moonlight.h"
#include "quadrature.h"

namespace sunlit::sky {
namespace {

/// Light of a disc of radius 1, of which a point at the distance r from the middle is as bright as
/// 1 − u − v + u µ + v µ², µ² = 1 − r².
struct Darkening {
  double u = 0.0, v = 0.0;

  double at(double r) const {
    const double square = std::max(0.0, 1.0 - r * r);
    return 1.0 - u - v + u * std::sqrt(square) + v * square;
  }
  /// Within that distance, in parts of π.
  double within(double r) const {
    const double inside = std::clamp(r, 0.0, 1.0);
    const double square = inside * inside, rest = 1.0 - square;
    return (1.0 - u - v) * square + u * 2.0 / 3.0 * (1.0 - rest * std::sqrt(rest)) +
           v * 0.5 * (1.0 - rest * rest);
  }
};

constexpr Darkening kEven{};
constexpr Darkening kSun{0.93, -0.23};

/// Share of a circle about the disc's middle that a cover, both in units of the disc's radius, leaves free.
double freeOfCircle(double r, double apart, double cover) {
  const double cosine = (r * r + apart * apart - cover * cover) / (2.0 * r * apart);
  return 1.0 - std::acos(std::clamp(cosine, -1.0, 1.0)) / kPi;
}

/// Circle by circle: free, cut or covered.
double uncovered(const Overlap& discs, const Darkening& light) {
  if (!discs.touch()) return 1.0;
  const double apart = discs.apart.rad() / discs.radius.rad();
  const double cover = discs.cover_radius.rad() / discs.radius.rad();
  const double low = std::min(std::abs(apart - cover), 1.0), high = std::min(apart + cover, 1.0);
  double sum = light.within(1.0) - light.within(high);
  if (apart > cover) sum += light.within(low);
  // By sin² of the node, since the integrand goes as a root at either end.
  static const std::vector<Node> nodes = gaussLegendre(32, 0.0, 0.5 * kPi);
  for (const Node& node : nodes) {
    const double sine = std::sin(node.x), cosine = std::cos(node.x);
    const double r = low + (high - low) * sine * sine;
    if (!(r > 0.0 && high > low)) continue;
    const double width = 2.0 * (high - low) * sine * cosine * node.weight;
    sum += 2.0 * r * light.at(r) * freeOfCircle(r, apart, cover) * width;
  }
  return std::clamp(sum / light.within(1.0), 0.0, 1.0);
}

Angle between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return Angle::radians(std::atan2(a.cross(b).norm(), a.dot(b)));
}

template <typename Lamp>
const Eigen::Vector3d& withoutRefraction(const Lamp& lamp) {
  return (lamp.geometric ? *lamp.geometric : lamp.apparent).vector();
}

constexpr double kAstronomicalUnit_m = 149597870700.0;  // IAU 2012
constexpr double kEarthWithAir_m = 1.01 * 6378137.0;    // its equator, WGS 84

}  // namespace

double uncoveredArea(const Overlap& discs) {
  return uncovered(discs, kEven);
}

double uncoveredSunlight(const Overlap& discs) {
  return uncovered(discs, kSun);
}

Overlap sunBehindMoon(const SunInSky& sun, const MoonInSky& moon) {
  return {between(withoutRefraction(sun), withoutRefraction(moon)), sunAngularRadius(sun.distance_au),
          moonAngularRadius(moon)};
}

double sunlightOnMoon(const SunInSky& sun, const MoonInSky& moon) {
  const Eigen::Vector3d from_centre = 1e3 * kEarthRadius_km * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d to_moon = from_centre + moon.distance_m * withoutRefraction(moon);
  const Eigen::Vector3d to_sun = from_centre + sun.distance_au * kAstronomicalUnit_m * withoutRefraction(sun);
  const Eigen::Vector3d from_moon = to_sun - to_moon;
  const double distance_m = to_moon.norm();
  const double apart = between(-to_moon, from_moon).rad();
  const double moon_rad = kMoonRadius_m / distance_m;
  Overlap discs;
  discs.radius = sunAngularRadius(from_moon.norm() / kAstronomicalUnit_m);
  discs.cover_radius = Angle::radians(std::asin(kEarthWithAir_m / distance_m));
  discs.apart = Angle::radians(apart - moon_rad);
  if (!discs.touch()) return 1.0;
  // Rings of the moon's disc of the same area, and points on half of each: the other half is as far away.
  constexpr int kRings = 12, kPoints = 16;
  double sum = 0.0;
  for (int ring = 0; ring < kRings; ++ring) {
    const double r = moon_rad * std::sqrt((ring + 0.5) / kRings);
    for (int point = 0; point <= kPoints; ++point) {
      const double turn = kPi * point / kPoints;
      discs.apart = Angle::radians(std::hypot(apart + r * std::cos(turn), r * std::sin(turn)));
      const double weight = point == 0 || point == kPoints ? 0.5 : 1.0;
      sum += weight / (kRings * kPoints) * uncoveredSunlight(discs);
    }
  }
  return std::min(sum, 1.0);
}

}  // namespace sunlit::sky
