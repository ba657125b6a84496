/// A clear atmosphere: what the sun becomes on its way to the ground.
///
/// Molecules, aerosol and ozone around a spherical Earth, in twelve wavelength bands; light scattered any
/// number of times. Sun from the zenith down to −18°; below, the last of it fades to nothing (moon and stars
/// are not the sun's light). Measured against published clear-sky illuminance of level ground: 99 klx at 60°
/// (100-110 for a high sun), 533 lx at −0.83° (410-585), 2.7 lx at −6° (2-3.5), 0.0044 lx at −12° (0.008).
/// See doc/equations.md.
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
  /// `apparent`, which makes the sky after sunset up to 1.7 times too bright if refraction is in it.
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
  Daylight daylight(const SunInSky& sun) const;

 private:
  struct Tables;
  std::unique_ptr<const Tables> tables_;
};

}  // namespace sunlit::sky
