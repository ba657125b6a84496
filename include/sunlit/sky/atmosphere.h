/// The atmosphere, clear unless weather is asked for: what sun, moon and the night's own glow become on their
/// way to the ground.
///
/// Molecules, aerosol and ozone around a spherical Earth, in twelve wavelength bands; light scattered any
/// number of times, and bent by refraction. Sunlight and daylight of a clear day are within 5 % of lighting
/// practice (IES 1984) for a sun of 90-10°. Illuminance of level ground is within 15 % of Janiczek & DeYoung
/// 1987 for a sun of 90-30°, within 25 % down to −12°, and within a factor of 2 below, where the glow of the
/// night takes over (1e-3 lx): 100 klx at 60°, 542 lx at −0.83°, 3.2 lx at −6°, 0.0072 lx at −12°; 0.29 lx
/// under a full moon overhead. Luminance is within 10 % of light paths traced through the same air, 14 % at
/// the very horizon.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "sunlit/quantity/direction.h"
#include "sunlit/quantity/field.h"
#include "sunlit/sky/daylight.h"
#include "sunlit/sky/table_store.h"
#include "sunlit/sky/weather.h"

namespace sunlit::sky {

struct AtmosphereOptions {
  /// Optical depth of air and aerosol over that of air alone (Preetham et al. 1999). 2 has an aerosol optical
  /// depth of 0.10 at 550 nm, 3 has 0.20, 6 has 0.50.
  double turbidity = 2.0;
  /// In a column of air: 500 is that of a northern spring. Ozone takes orange from light that comes a long
  /// way, and so makes dusk blue.
  double ozone_du = 300.0;
  double ground_albedo = 0.2;
  double observer_height_m = 0.0;
};

inline std::vector<Field> fieldsOf(AtmosphereOptions& options) {
  return {{"turbidity", &options.turbidity, "", {1, 10}, "haziness: 1 is pure air, 2 a clear day, 10 haze"},
          {"ozone", &options.ozone_du, "DU", {0, 600}, "300 is the Earth's mean, 100 the ozone hole's"},
          {"ground_albedo",
           &options.ground_albedo,
           "",
           {0, 1},
           "of the land around the scene; auto: as the world is from above"},
          {"observer_height", &options.observer_height_m, "m", {0, 12000}, "above sea level"}};
}

/// Throws std::invalid_argument naming key, value and range.
void validate(const AtmosphereOptions& options);

/// All that Atmosphere(air).daylight() would refuse of this weather, at once: throws as validate() does for
/// either, and for a visibility that the clear air does not have.
void validate(const Weather& weather, const AtmosphereOptions& air);

/// Where the sun stands and how far away it is.
struct SunInSky {
  Direction apparent;        ///< with refraction: where the disc and its aureole are seen
  double distance_au = 1.0;  ///< 0.97 … 1.03
  /// Without refraction: lights the air above, whose rays pass high and are bent less. Default: as
  /// `apparent`, which makes the sky after sunset up to 1.6 times too bright if refraction is in it.
  std::optional<Direction> geometric = std::nullopt;
};

/// Precomputes what does not depend on sun and moon (3 s of processor time, next to nothing where `kept` has
/// the tables of such air); daylight() then costs 30 ms of it, and as much again for a moon, and may be
/// called from many threads. Both use TBB inside, and give the same bits for any thread count.
class Atmosphere {
 public:
  explicit Atmosphere(const AtmosphereOptions& options, const TableStore& kept = {});
  ~Atmosphere();
  Atmosphere(Atmosphere&&) noexcept;
  Atmosphere& operator=(Atmosphere&&) noexcept;

  /// Sun, moon and glow together. What is drowned is left out: the moon's sky with the sun above 10°, the
  /// glow with the sun up, and the sun's sky with the sun below −22°. Throws std::invalid_argument for a
  /// distance or phase angle outside its range.
  /// A moon before the sun dims all of its light, and the Earth's shadow the moon's: see eclipse.h.
  /// Cloud and fog change only what they are in the way of. Throws also what validate() does, and for a
  /// visibility beyond that of the clear air.
  Daylight daylight(const SunInSky& sun, const NightSky& night = {}, const Weather& weather = {}) const;

 private:
  struct Tables;
  struct Lamps {
    const SunInSky& sun;
    const NightSky& night;
  };
  void makeForWeather() const;
  void addWeather(const Weather& weather, const Lamps& lamps, SkyTable* table) const;
  void addMoon(const MoonInSky& moon, const SunInSky& sun, SkyTable* table) const;
  std::unique_ptr<const Tables> tables_;
};

}  // namespace sunlit::sky
