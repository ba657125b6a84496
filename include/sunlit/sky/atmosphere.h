/// A clear atmosphere: what the sun becomes on its way to the ground.
#pragma once

#include <memory>

#include "sunlit/quantity/direction.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::sky {

struct AtmosphereOptions {
  double turbidity = 3.0;       ///< Linke-like haziness of the aerosol, 1 (pure air) … 10 (haze)
  double ground_albedo = 0.2;   ///< of the land around the scene, 0 … 1
  double observer_height_m = 0.0;  ///< above sea level, 0 … 8000 m
};

/// Throws std::invalid_argument naming key, value and range.
void validate(const AtmosphereOptions& options);

/// Where the sun stands and how far away it is.
struct SunInSky {
  Direction apparent;        ///< with refraction
  double distance_au = 1.0;  ///< 0.97 … 1.03
};

/// Precomputes what does not depend on the sun (seconds at most); daylight() then costs milliseconds and may be called
/// from many threads.
class Atmosphere {
 public:
  explicit Atmosphere(const AtmosphereOptions& options);
  ~Atmosphere();
  Atmosphere(Atmosphere&&) noexcept;
  Atmosphere& operator=(Atmosphere&&) noexcept;

  Daylight daylight(const SunInSky& sun) const;

 private:
  struct Tables;
  std::unique_ptr<const Tables> tables_;
};

}  // namespace sunlit::sky
