/// The sun as seen from a place on Earth.
#pragma once

#include <vector>

#include "sunlit/astronomy/solar_coordinates.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/direction.h"
#include "sunlit/quantity/instant.h"
#include "sunlit/quantity/site.h"

namespace sunlit::astronomy {

/// Topocentric: parallax is in it. Elevations are of the centre of the disc.
struct SunPosition {
  Azimuth azimuth;
  Angle elevation;            ///< apparent: lifted by refraction
  Angle elevation_geometric;  ///< without refraction
  Angle right_ascension;      ///< α′, [0°, 360°)
  Angle declination;          ///< δ′
  Angle hour_angle;           ///< H′, westward from the meridian, (−180°, 180°]

  Angle zenith() const { return Angle::degrees(90.0) - elevation; }  ///< apparent
  Direction direction() const {
    return Direction(azimuth, elevation);
  }  ///< in `map`, towards the apparent sun
};

/// A flat surface, described as in SPA.
struct Surface {
  Angle slope;         ///< tilt from the horizontal
  Angle azm_rotation;  ///< azimuth of its normal from south, positive west
};

inline std::vector<Field> fieldsOf(Surface& surface) {
  return {
      {"slope", &surface.slope, "deg", {-360, 360}, "tilt from the horizontal"},
      {"azm_rotation", &surface.azm_rotation, "deg", {-360, 360}, "of its normal from south, positive west"}};
}

/// Reda & Andreas (2008), steps 3.11 to 3.14, with refraction() in the place of eq. 42 below the horizon.
SunPosition sunPosition(const SolarCoordinates& sun, const Site& site, const Air& air);

/// The same of many places at one instant: time-only terms are computed once.
std::vector<SunPosition> sunPositions(const SolarCoordinates& sun, const std::vector<Site>& sites,
                                      const Air& air);

/// One place at many instants: per-place terms are computed once.
std::vector<SunPosition> sunPositions(const std::vector<Instant>& instants, const EarthRotation& earth,
                                      const Site& site, const Air& air);

/// One place at one instant.
SunPosition sunPosition(const Instant& instant, const EarthRotation& earth, const Site& site, const Air& air);

/// Between the direction to the apparent sun and the normal of `surface`, 0° … 180°. Reda & Andreas (2008),
/// eq. 47.
Angle incidence(const SunPosition& sun, const Surface& surface);

}  // namespace sunlit::astronomy
