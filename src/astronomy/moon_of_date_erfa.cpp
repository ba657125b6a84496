#include <erfa.h>
#include <erfam.h>

#include "astronomy/moon_of_date.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::astronomy {

Eigen::Vector3d moonOfDate(double jce, const Nutation& wobble) {
  constexpr double kJ2000 = 2451545.0;
  const double tt_days = jce * 36525.0;
  double moon_au[2][3];
  eraMoon98(kJ2000, tt_days, moon_au);
  // ERFA left out the light time that Meeus has in his mean longitude.
  const double light_time_days = eraPm(moon_au[0]) * ERFA_AULT / ERFA_DAYSEC;
  double seen_au[3];
  eraPpsp(moon_au[0], -light_time_days, moon_au[1], seen_au);

  // The same precession by which eraMoon98 came from the ecliptic of date, so that its errors in a far year
  // cancel.
  double obliquity, bias[3][3], precession[3][3], both[3][3], nutation_matrix[3][3],
      true_from_celestial[3][3];
  eraPn06(kJ2000, tt_days, wobble.longitude_deg * kRadPerDeg, wobble.obliquity_deg * kRadPerDeg, &obliquity,
          bias, precession, both, nutation_matrix, true_from_celestial);
  double of_date_au[3];
  eraRxp(true_from_celestial, seen_au, of_date_au);
  return {of_date_au[0], of_date_au[1], of_date_au[2]};
}

}  // namespace sunlit::astronomy
