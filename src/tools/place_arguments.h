/// Command line options that say where on Earth and on which day.
#pragma once

#include <optional>
#include <string>

#include "sunlit/astronomy/civil_time.h"
#include "sunlit/quantity/site.h"
#include "sunlit/studio/command_line.h"
#include "sunlit/studio/sky.h"
#include "sunlit/studio/studio.h"

namespace sunlit::tools {

struct PlaceOptions {
  Site site{Angle::degrees(55.792115), Angle::degrees(49.122254), 90.0};  ///< of the experiment
  astronomy::CivilDate date{2024, 7, 1, 3.0};                             ///< with the time zone, h
  sky::AtmosphereOptions air;  ///< but for the observer's height, which is the site's, and the ground
  std::optional<double> ground_albedo;  ///< nothing: that of the world
  sky::Weather weather;
  scene::SurfaceState surfaces;
};

/// That of the site's height, but for the ground.
sky::AtmosphereOptions airOf(const PlaceOptions& place);

/// "2024-07-01". Throws std::invalid_argument naming `option` for a day that there is not.
astronomy::CivilDate dateOf(const std::string& option, const std::string& text, double timezone);
/// As a person would type it.
std::string textOfDate(const astronomy::CivilDate& date);

/// --cover, --visibility and the other rows of the weather, --wet, --snow and those of what it leaves.
void addWeather(studio::CommandLine* line, sky::Weather* weather, scene::SurfaceState* surfaces);

/// Throws std::invalid_argument where such a row is given that only tells more of weather that is not, by the
/// values of the others, and for weather that this `air` cannot have.
void requireWeather(const studio::CommandLine& line, const sky::Weather& weather,
                    const scene::SurfaceState& surfaces, const sky::AtmosphereOptions& air);

/// --site, --date, --timezone, --turbidity, --ozone, --ground-albedo and the weather.
void addPlace(studio::CommandLine* line, PlaceOptions* options);

/// A line on stderr where --timezone is not given, and by the default the sun is highest far from 12:00; and
/// one where `world` names another site. Throws as scene::siteOf().
void tellOfPlace(const studio::CommandLine& line, const PlaceOptions& place,
                 const studio::WorldOptions& world);

/// The sky of `place`, over the land that goes on beyond the world of `studio`, whose albedo it prints.
studio::Sky skyOver(const studio::Studio& studio, const PlaceOptions& place, bool stars = true);

/// The weather of `place` at an `hour` of its day: the wind has blown since midnight.
sky::Weather weatherAt(const PlaceOptions& place, double hour);

/// What is in the sky over `place` at an `hour` of its day, −24 … 72; outside 0 … 24 it is of the days before
/// and after.
studio::SkyBodies bodiesOf(const PlaceOptions& place, double hour);

/// ", sun 97.2 % covered" or ", moon dimmed by 55.0 %" where an eclipse is seen above the horizon; else
/// nothing.
std::string textOfEclipse(const studio::SkyBodies& bodies);

}  // namespace sunlit::tools
