/// The whole sky over a place at any instant, from astronomy to light.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "sunlit/astronomy/civil_time.h"
#include "sunlit/quantity/instant.h"
#include "sunlit/quantity/site.h"
#include "sunlit/sky/atmosphere.h"

namespace sunlit::tools {

struct PlaceOptions {
  Site site{Angle::degrees(55.792115), Angle::degrees(49.122254), 90.0};  ///< of the experiment
  astronomy::CivilDate date{2024, 7, 1, 3.0};                             ///< with the time zone, h
  sky::AtmosphereOptions air;  ///< but for the observer's height, which is the site's
};

/// Help for the options that PlaceArguments takes.
extern const char* const kPlaceHelp;

/// Command line options that say where on Earth and on which day.
class PlaceArguments {
 public:
  /// False for an option that is none of these. Throws std::invalid_argument naming option, value and what is
  /// allowed.
  bool take(const std::string& key, const std::string& value);
  const PlaceOptions& options() const { return options_; }

 private:
  PlaceOptions options_;
};

/// Light and what it comes from.
struct SkyMoment {
  sky::Daylight day;
  Angle sun_elevation;   ///< apparent
  Angle moon_elevation;  ///< apparent
  double moon_illuminated_fraction = 0.0;
};

class SkyOfInstant {
 public:
  /// Precomputes the atmosphere and reads the stars.
  explicit SkyOfInstant(const PlaceOptions& place);

  /// `hour` of the day of PlaceOptions, −24 … 72; outside 0 … 24 it is of the days before and after.
  SkyMoment at(double hour) const;

 private:
  PlaceOptions place_;
  Instant midnight_;
  sky::Atmosphere atmosphere_;
  std::shared_ptr<const std::vector<sky::Star>> stars_;
};

}  // namespace sunlit::tools
