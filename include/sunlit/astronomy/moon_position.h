/// The moon as seen from a place on Earth, and how much of it is lit.
#pragma once

#include "sunlit/astronomy/solar_coordinates.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/direction.h"
#include "sunlit/quantity/instant.h"
#include "sunlit/quantity/moon.h"
#include "sunlit/quantity/site.h"

namespace sunlit::astronomy {

/// The moon as seen from the centre of the Earth, apparent, in the true equator and equinox of date.
struct LunarCoordinates {
  Angle right_ascension;  ///< α, [0°, 360°)
  Angle declination;      ///< δ
  double distance_m = kMeanMoonDistance_m;
};

/// Meeus, Astronomical Algorithms (2nd ed. 1998), chapter 47, as ERFA's eraMoon98 computes it, with light
/// time, or, where ERFA is older than that, a series of our own, 0.1″ from it; precession IAU 2006, nutation
/// as in SPA. Against S. L. Moshier's ephemeris, which follows JPL's DE404: 3″ rms, 10″ at most and 13 km
/// from 1950 to 2050, 37″ at most from −1300 to 3000; ERFA states 18″ for its own comparison. Any instant
/// from year −2000 to 6000 is accepted. Far from today the unknown rotation of the Earth counts more than the
/// series: 1 s of ΔT moves the moon by 0.5″ among the stars, and ΔT of −1300 is known to several minutes
/// only.
LunarCoordinates lunarCoordinates(const Instant& instant, const EarthRotation& earth);

/// Topocentric: parallax is in it. All but `bright_limb` are of the centre of the disc.
struct MoonPosition {
  Azimuth azimuth;
  Angle elevation;            ///< apparent: lifted by refraction
  Angle elevation_geometric;  ///< without refraction
  Angle right_ascension;      ///< [0°, 360°)
  Angle declination;
  double distance_m = kMeanMoonDistance_m;  ///< from the observer
  Angle phase_angle;                        ///< at the moon between sun and observer: 0° full, 180° new
  double illuminated_fraction = 1.0;        ///< of the disc's area: 0 new, 1 full
  Angle bright_limb;  ///< position angle of the middle of the bright limb, from celestial north through east,
                      ///< [0°, 360°)

  Angle zenith() const { return Angle::degrees(90.0) - elevation; }  ///< apparent
  Angle angularRadius() const;                                       ///< asin(radius / distance)
  /// In `map`, towards where the moon is seen.
  Direction direction() const { return Direction(azimuth, elevation); }
  /// In `map`, towards where it would be seen without air.
  Direction geometricDirection() const { return Direction(azimuth, elevation_geometric); }
};

/// `moon` and `sun` of one instant. Refraction is refraction(), as for the sun. Diurnal aberration, 0.3″, is
/// left out. Lit share and bright limb: Meeus, eq. 48.1 and 48.5; the phase angle, his 48.3, is that
/// between vectors; all of both bodies as the observer sees them.
MoonPosition moonPosition(const LunarCoordinates& moon, const SolarCoordinates& sun, const Site& site,
                          const Air& air);

/// One place at one instant.
MoonPosition moonPosition(const Instant& instant, const EarthRotation& earth, const Site& site,
                          const Air& air);

}  // namespace sunlit::astronomy
