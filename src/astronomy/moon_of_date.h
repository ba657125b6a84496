/// Where the moon stands among the stars, by ERFA, or by our own series where ERFA has none yet (before 2.0).
#pragma once

#include <Eigen/Core>

#include "astronomy/nutation.h"

namespace sunlit::astronomy {

/// The moon as seen from the centre of the Earth, its light time allowed for, in the true equator and equinox
/// of date, au. `jce`: Julian centuries of Terrestrial Time since J2000; `wobble`: of then.
Eigen::Vector3d moonOfDate(double jce, const Nutation& wobble);

}  // namespace sunlit::astronomy
