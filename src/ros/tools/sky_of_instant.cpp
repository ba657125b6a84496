#include "ros/tools/sky_of_instant.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "ros/tools/arguments.h"
#include "sunlit/astronomy/celestial.h"
#include "sunlit/astronomy/limits.h"
#include "sunlit/astronomy/moon_position.h"
#include "sunlit/astronomy/sun_position.h"
#include "sunlit/ros/star_light.h"

namespace sunlit::tools {

const char* const kPlaceHelp =
    R"(  --site LAT,LON[,ELEVATION]     deg, deg and m (default 55.792115,49.122254,90)
  --date YYYY-MM-DD              (default 2024-07-01)
  --timezone HOURS               east of UTC, -18 ... 18 (default 3)
  --turbidity NUMBER             haziness of the air, 1 ... 10 (default 2)
  --ozone DU                     in the air, Dobson units, 0 ... 600 (default 300)
)";

namespace {

astronomy::CivilDate dateOf(const std::string& text, double timezone) {
  astronomy::CivilDate date;
  int used = 0;
  const int fields = std::sscanf(text.c_str(), "%d-%d-%d%n", &date.year, &date.month, &date.day, &used);
  if (fields != 3 || static_cast<std::size_t>(used) != text.size())
    reject("--date", text, "year-month-day, such as 2024-07-01");
  date.timezone = timezone;
  try {
    astronomy::midnightOf(date);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("--date is \"" + text + "\": " + error.what());
  }
  return date;
}

Site siteOf(const std::string& text, double fallback_elevation_m) {
  const std::vector<double> values = numbers("--site", text, {2, 3});
  const Site site{Angle::degrees(values[0]), Angle::degrees(values[1]),
                  values.size() == 3 ? values[2] : fallback_elevation_m};
  try {
    astronomy::require(site);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("--site is \"" + text + "\": " + error.what());
  }
  return site;
}

sky::AtmosphereOptions airOver(const PlaceOptions& place) {
  sky::AtmosphereOptions options = place.air;
  options.observer_height_m = std::clamp(place.site.elevation_m, 0.0, 8000.0);
  return options;
}

}  // namespace

bool PlaceArguments::take(const std::string& key, const std::string& value) {
  if (key == "--site") {
    options_.site = siteOf(value, 0.0);
  } else if (key == "--date") {
    options_.date = dateOf(value, options_.date.timezone);
  } else if (key == "--timezone") {
    options_.date.timezone = numberWithin(key, value, -18.0, 18.0);
  } else if (key == "--turbidity") {
    options_.air.turbidity = numberWithin(key, value, 1.0, 10.0);
  } else if (key == "--ozone") {
    options_.air.ozone_du = numberWithin(key, value, 0.0, 600.0);
  } else {
    return false;
  }
  return true;
}

SkyOfInstant::SkyOfInstant(const PlaceOptions& place)
    : place_(place), midnight_(astronomy::midnightOf(place.date)), atmosphere_(airOver(place)) {
  const ros_interface::StarLight light = ros_interface::loadStars();
  for (const std::string& warning : light.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  stars_ = light.stars;
}

SkyMoment SkyOfInstant::at(double hour) const {
  const Instant instant = midnight_.plusSeconds(hour * 3600.0);
  const Air air;
  const astronomy::SolarCoordinates solar = astronomy::solarCoordinates(instant, {});
  const astronomy::SunPosition sun = astronomy::sunPosition(solar, place_.site, air);
  const sky::SunInSky sun_in_sky{sun.direction(), solar.distance_au,
                                 Direction(sun.azimuth, sun.elevation_geometric)};
  const astronomy::MoonPosition moon =
      astronomy::moonPosition(astronomy::lunarCoordinates(instant, {}), solar, place_.site, air);
  const sky::MoonInSky moon_in_sky{moon.direction(), moon.geometricDirection(), moon.distance_m,
                                   moon.phase_angle};
  const sky::NightSky night{moon_in_sky, astronomy::mapFromCelestial(instant, {}, place_.site), stars_};
  return {atmosphere_.daylight(sun_in_sky, night), sun.elevation, moon.elevation, moon.illuminated_fraction};
}

}  // namespace sunlit::tools
