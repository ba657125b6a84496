/// Where the stars stand: from catalogues of J2000 to the axes of `map`.
#pragma once

#include <Eigen/Core>

#include "sunlit/astronomy/solar_coordinates.h"
#include "sunlit/quantity/instant.h"
#include "sunlit/quantity/site.h"

namespace sunlit::astronomy {

/// Rotation that takes a vector in equatorial axes of J2000 (ICRS: x to the vernal equinox, z to the north
/// celestial pole) to `map` (ENU).
///
/// Precession of Vondrák, Capitaine & Wallace (2011), which holds for the years −2000 to 6000 and far beyond,
/// nutation and sidereal time of SPA, so that sun, moon and stars turn with one Earth. Within 1″ of ERFA's
/// IAU 2006 matrices from 1900 to 2100. No refraction, and no aberration: a star is seen up to 20.5″ from
/// there. For vectors that do not depend on the observer's place: stars, not the moon.
Eigen::Matrix3d mapFromCelestial(const Instant& instant, const EarthRotation& earth, const Site& site);

/// The unit vector of a right ascension and declination, in the axes that both are measured in.
Eigen::Vector3d equatorial(Angle right_ascension, Angle declination);

}  // namespace sunlit::astronomy
