/// How strong the moon's light is, and from where the sun lights its face.
#pragma once

#include "scattered_sky.h"
#include "sunlit/sky/atmosphere.h"
#include "sunlit/sky/night.h"

namespace sunlit::sky {

/// Throws std::invalid_argument for a distance or phase angle outside its range.
void validate(const MoonInSky& moon);

/// Moonlight above the air, relative to the sun's irradiance at 1 AU. The phase law V = −12.73 + 0.026 |α| +
/// 4e-9 α⁴ (α in degrees, mean distance; Allen 1976, eq. 9 of Krisciunas & Schaefer 1991) is within 0.2 mag
/// of measurements to 150°; beyond, it fades smoothly to nothing at the new moon. The opposition surge of the
/// last 7° (up to a third more) is left out. Redder than sunlight: albedo ∝ λ^1.1, from B − V = 0.92 of the
/// moon and 0.65 of the sun. In the Earth's shadow it is dimmed by sunlightOnMoon(), down to kMoonInUmbra.
Spectrum moonStrength(const MoonInSky& moon, const SunInSky& sun);

/// Of kMoonRadius_m.
Angle moonAngularRadius(const MoonInSky& moon);

/// The direction of the sun seen from the moon: at the phase angle from the observer, on the sun's side.
Direction moonLitFrom(const MoonInSky& moon, const Direction& sun);

}  // namespace sunlit::sky
