#include "tools/place_arguments.h"

#include <cmath>
#include <cstdio>
#include <regex>
#include <stdexcept>
#include <string>

#include "sunlit/scene/world_site.h"
#include "sunlit/sky/eclipse.h"
#include "sunlit/studio/other_site.h"
#include "tools/terminal.h"

namespace sunlit::tools {

astronomy::CivilDate dateOf(const std::string& option, const std::string& text, double timezone) {
  // 24 may be meant as 2024; of more than nine digits no int is made.
  static const std::regex form("(-?[0-9]{4,9})-([0-9]{1,2})-([0-9]{1,2})");
  std::smatch found;
  if (!std::regex_match(text, found, form))
    refuse(option, '"' + text + '"', "year-month-day with a year of four digits, such as 2024-07-01");
  const astronomy::CivilDate date{std::stoi(found[1]), std::stoi(found[2]), std::stoi(found[3]), timezone};
  try {
    astronomy::midnightOf(date);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(option + " is \"" + text + "\": " + error.what());
  }
  return date;
}

std::string textOfDate(const astronomy::CivilDate& date) {
  char text[32];
  std::snprintf(text, sizeof text, "%04d-%02d-%02d", date.year, date.month, date.day);
  return text;
}

namespace {

studio::SkyOptions skyOptionsOf(const PlaceOptions& place) {
  return {place.air, std::nullopt, place.ground_albedo};
}

}  // namespace

sky::AtmosphereOptions airOf(const PlaceOptions& place) {
  return airOf(skyOptionsOf(place), place.site.elevation_m);
}

void addWeather(studio::CommandLine* line, sky::Weather* weather, scene::SurfaceState* surfaces) {
  line->group("Weather");
  const std::vector<Field> rows = fieldsOf(*weather);
  line->add("--cover OKTAS", fieldOf(rows, "cover"));
  line->add("--optical-depth NUMBER", fieldOf(rows, "optical_depth"));
  line->add("--overcast", fieldOf(rows, "overcast"));
  line->add("--visibility M", fieldOf(rows, "visibility"));
  line->add("--fog-top M", fieldOf(rows, "fog_top"));
  line->add("--rain MM/H", fieldOf(rows, "rain"));
  line->add("--cloud-base M", fieldOf(rows, "cloud_base"));
  line->add("--wind M/S", fieldOf(rows, "wind"));
  line->add("--wind-from DEG", fieldOf(rows, "wind_from"));
  line->add("--cloud-seed N", fieldOf(rows, "cloud_seed"));
  const std::vector<Field> left = fieldsOf(*surfaces);
  line->add("--wet SHARE", fieldOf(left, "wet"));
  line->add("--puddles SHARE", fieldOf(left, "puddles"));
  line->add("--snow M", fieldOf(left, "snow"));
  line->add("--ground-seed N", fieldOf(left, "ground_seed"));
}

void requireWeather(const studio::CommandLine& line, const sky::Weather& weather,
                    const scene::SurfaceState& surfaces, const sky::AtmosphereOptions& air) {
  const auto requireUse = [&line](const std::string& option, bool is_of_use, const std::string& needs) {
    if (line.has(option) && !is_of_use) throw std::invalid_argument(option + " needs " + needs + " too");
  };
  const bool has_cloud = weather.cover_oktas > 0.0;
  requireUse("--optical-depth", has_cloud, "--cover above 0");
  // Of the standard overcast sky validate() says more, where there is any cloud.
  requireUse("--overcast", has_cloud && (!isBroken(weather) || weather.overcast == sky::Overcast::kCie),
             "--cover 8");
  requireUse("--fog-top", weather.visibility_m.has_value(), "--visibility in m");
  // Rain falls from the cloud base, is slanted by the wind, and has drops by the seed.
  for (const char* of_both : {"--cloud-base", "--wind", "--cloud-seed"})
    requireUse(of_both, isBroken(weather) || weather.rain_mm_per_h > 0.0,
               "--cover above 0 and below 8, or --rain above 0,");
  requireUse("--wind-from", weather.wind_m_per_s > 0.0, "--wind above 0");
  requireUse("--ground-seed", surfaces.puddles > 0.0 || surfaces.snow_m > 0.0, "--puddles or --snow above 0");
  validate(weather, air);
}

void addPlace(studio::CommandLine* line, PlaceOptions* options) {
  line->group("Place, day and air");
  line->add("--site LAT,LON[,ELEVATION]", "", fieldsOf(options->site));
  line->add("--date YYYY-MM-DD",
            {"date", OwnForm{textOfDate(options->date)}, "", {}, "as the time zone has it"})
      .then([options](const std::string& option, const std::string& value) {
        options->date = dateOf(option, value, options->date.timezone);
      });
  CivilDateTime civil;
  Field timezone = fieldOf(fieldsOf(civil), "timezone");
  timezone.place = &options->date.timezone;
  line->add("--timezone HOURS", timezone);
  line->add("--turbidity NUMBER", fieldOf(fieldsOf(options->air), "turbidity"));
  line->add("--ozone DU", fieldOf(fieldsOf(options->air), "ozone"));
  Field ground = fieldOf(fieldsOf(options->air), "ground_albedo");
  ground.place = NumberOrWord{&options->ground_albedo, "auto"};
  line->add("--ground-albedo NUMBER", ground);
  addWeather(line, &options->weather, &options->surfaces);
}

namespace {

void tellOfTimezone(const studio::CommandLine& line, const PlaceOptions& place) {
  constexpr double kFar = 1.5, kHoursPerDay = 24.0, kDegreesPerHour = 15.0;
  constexpr double kPolar_deg = 89.0;  // the sun stands about as high all day
  const double late = std::remainder(place.date.timezone - place.site.longitude.deg() / kDegreesPerHour,
                                     kHoursPerDay);  // the sun's noon, after 12:00
  const bool is_polar = std::abs(place.site.latitude.deg()) > kPolar_deg;
  if (line.has("--timezone") || is_polar || std::abs(late) <= kFar) return;
  const long quarters = std::lround((12.0 + late) * 4.0) % 96;  // no finer: the sun is up to 17 minutes late
  char text[128];
  std::snprintf(
      text, sizeof text,
      "hours are of UTC%+g; the sun is highest there at about %02ld:%02ld: --timezone gives another "
      "zone",
      place.date.timezone, quarters / 4, quarters % 4 * 15);
  onTerminal().warning(text);
}

}  // namespace

void tellOfPlace(const studio::CommandLine& line, const PlaceOptions& place,
                 const studio::WorldOptions& world) {
  tellOfTimezone(line, place);
  const std::optional<scene::WorldSite> named = scene::siteOf(world.name, world.searchPath());
  if (named && !studio::isSiteOf(*named, place.site)) onTerminal().warning(studio::otherSiteText(*named));
}

studio::Sky skyOver(const studio::Studio& studio, const PlaceOptions& place, bool stars) {
  studio::SkyOptions options = skyOptionsOf(place);
  options.stars = stars;
  options.cache_dir = studio.cacheFolder();
  studio::Sky sky(options, onTerminal());
  sky.over(studio.worlds());
  std::printf("albedo of the land beyond the world: %g%s\n", sky.groundAlbedo(),
              place.ground_albedo ? ", as given" : "");
  std::fflush(stdout);
  return sky;
}

sky::Weather weatherAt(const PlaceOptions& place, double hour) {
  sky::Weather weather = place.weather;
  weather.clock_s = hour * 3600.0;
  return weather;
}

studio::SkyBodies bodiesOf(const PlaceOptions& place, double hour) {
  return studio::bodiesAt(astronomy::midnightOf(place.date).plusSeconds(hour * 3600.0), place.site);
}

std::string textOfEclipse(const studio::SkyBodies& bodies) {
  if (!bodies.moon) return std::string();
  const auto percent = [](double share) {
    char text[16];
    std::snprintf(text, sizeof text, "%.1f %%",
                  std::floor(1e3 * share) / 10.0);  // only what is total has 100.0
    return std::string(text);
  };
  std::string text;
  const double covered = 1.0 - sky::uncoveredArea(sky::sunBehindMoon(bodies.sun, *bodies.moon));
  if (covered > 0.0 && bodies.sun.apparent.vector().z() > 0.0)
    text += ", sun " + percent(covered) + " covered";
  const double lost = 1.0 - sky::sunlightOnMoon(bodies.sun, *bodies.moon);
  if (lost > 0.0 && bodies.moon->apparent.vector().z() > 0.0) text += ", moon dimmed by " + percent(lost);
  return text;
}

}  // namespace sunlit::tools
