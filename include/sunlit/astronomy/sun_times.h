/// Sunrise, transit, sunset and the twilights of one local day.
#pragma once

#include <optional>

#include "sunlit/astronomy/civil_time.h"
#include "sunlit/astronomy/solar_coordinates.h"
#include "sunlit/quantity/site.h"

namespace sunlit::astronomy {

/// Whether the sun crosses the horizon on a local day, and if not, on which side it stays.
enum class SunState { kNormal, kPolarDay, kPolarNight };

/// The first upward (dawn) and the last downward (dusk) crossing of one elevation, in hours since local
/// midnight. The dusk may come before the dawn, where the sun sets just after midnight.
struct Crossings {
  std::optional<double> dawn;
  std::optional<double> dusk;
};

/// Hours since local midnight, [0, 24]; without a value where there is no such event on that day.
struct SunTimes {
  SunState state = SunState::kNormal;
  Crossings horizon;              ///< sunrise and sunset: upper rim on the horizon, horizonElevation()
  Crossings civil;                ///< centre at −6°, geometric
  Crossings nautical;             ///< −12°
  Crossings astronomical;         ///< −18°
  std::optional<double> transit;  ///< centre on the meridian
};

/// By root-finding on the geometric elevation over the local day, [midnight, next midnight), in the fixed
/// time zone of `date` (daylight saving is up to the caller). To 1e-6 h for every crossing that a 10 min scan
/// and its refined extremes can tell apart. Of `air` only refraction_at_horizon counts. Throws as
/// instantOf().
SunTimes sunTimes(const CivilDate& date, const Site& site, const Air& air, const EarthRotation& earth);

}  // namespace sunlit::astronomy
