/// What sun, moon and Earth hide of one another's light.
#pragma once

#include "sunlit/quantity/angle.h"
#include "sunlit/sky/atmosphere.h"
#include "sunlit/sky/night.h"

namespace sunlit::sky {

/// Two discs in the sky, of which the one that covers is the nearer.
struct Overlap {
  Angle apart;  ///< between the centres, 0 or more
  Angle radius, cover_radius;

  bool touch() const { return apart < radius + cover_radius; }
};

/// Share, 0 … 1, of the disc's area that is not covered; 1 where they do not touch. To 1e-6.
double uncoveredArea(const Overlap& discs);
/// The same of the light of a sun, which is darker towards its rim:
/// I(µ) / I(1) = 0.30 + 0.93 µ − 0.23 µ² at 550 nm (Allen's Astrophysical Quantities, 4th ed. 2000, 14.7).
double uncoveredSunlight(const Overlap& discs);

/// The sun's disc and the moon's as they are seen from the scene, without refraction. What is right of the
/// moon's place, 3″ rms, makes contacts right to some 20 s; mountains at its rim are left out.
Overlap sunBehindMoon(const SunInSky& sun, const MoonInSky& moon);

/// Share, 0 … 1, of the sun's light that still falls straight on the moon, in the mean over its disc; 1
/// outside of the penumbra, 0 in the umbra. From the moon the Earth is a disc of 1.01 times its equatorial
/// radius, since its air is dark down there (Danjon 1951: 1 + 1/85 − 1/594, of a mean flattened Earth), as in
/// Espenak & Meeus, Five Millennium Canon of Lunar Eclipses (2009, NASA/TP-2009-214172). Its centre is taken
/// to be straight below the scene, up to 21 km beside where it is: contacts are right to 90 s.
double sunlightOnMoon(const SunInSky& sun, const MoonInSky& moon);

/// Of the light of sky and ground under a covered sun what comes from air outside of the moon's shadow. Three
/// to four orders of magnitude below that of the whole sun, depending on wavelength; the corona counts for
/// nothing beside it (Emde & Mayer 2007, Atmos. Chem. Phys. 7, 2259).
constexpr double kSkyInTotality = 3e-4;

/// Of the moon's light what the Earth's air bends into the umbra, red: full moons of −3.32 and −1.7 mag in
/// the middle of totality are 1.7e-4 and 4e-5 of one that is not eclipsed (Hernitschek, Schmidt & Vollmer
/// 2008, Appl. Opt. 47, H62); volcanoes' ash makes it less.
constexpr double kMoonInUmbra = 1e-4;

}  // namespace sunlit::sky
