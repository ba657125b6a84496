/// A clear atmosphere: what the sun becomes on its way to the ground.
///
/// Molecules, aerosol and ozone around a spherical Earth, in twelve wavelength bands; light scattered any
/// number of times. Sun from the zenith down to −18°; below, the last of it fades to nothing (moon and stars
/// are not the sun's light). Level ground gets 99 klx at 60° and 116 klx at 90° (published: 100-110 for a
/// high sun), 496 lx at −0.83° (410-585), 2.5 lx at −6° (2-3.5), 0.0041 lx at −12° (0.008). Luminance is
/// within 15 % of light paths traced through the same air from 10° of elevation up, and up to 40 % too bright
/// at a hazy horizon under a low sun.
#pragma once

#include <memory>
#include <optional>

#include "sunlit/quantity/direction.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::sky {

struct AtmosphereOptions {
  double turbidity = 3.0;          ///< Linke-like haziness of the aerosol, 1 (pure air) … 10 (haze)
  double ground_albedo = 0.2;      ///< of the land around the scene, 0 … 1
  double observer_height_m = 0.0;  ///< above sea level, 0 … 8000 m
};

/// Throws std::invalid_argument naming key, value and range.
void validate(const AtmosphereOptions& options);

/// Where the sun stands and how far away it is.
struct SunInSky {
  Direction apparent;        ///< with refraction: where the disc and its aureole are seen
  double distance_au = 1.0;  ///< 0.97 … 1.03
  /// Without refraction: lights the air above, whose rays pass high and are bent less. Default: as
  /// `apparent`, which makes the sky after sunset up to 1.6 times too bright if refraction is in it.
  std::optional<Direction> geometric = std::nullopt;
};

/// Precomputes what does not depend on the sun (seconds at most); daylight() then costs milliseconds and may
/// be called from many threads. Both use TBB inside, and give the same bits for any thread count.
class Atmosphere {
 public:
  explicit Atmosphere(const AtmosphereOptions& options);
  ~Atmosphere();
  Atmosphere(Atmosphere&&) noexcept;
  Atmosphere& operator=(Atmosphere&&) noexcept;

  /// Throws std::invalid_argument for a distance outside its range.
  Daylight daylight(const SunInSky& sun, const NightSky& night = {}) const;

 private:
  struct Tables;
  std::unique_ptr<const Tables> tables_;
};

}  // namespace sunlit::sky
