#include "sunlit/studio/sky.h"

#include <algorithm>
#include <string>

#include "studio/air_tables.h"
#include "studio/tell.h"
#include "sunlit/astronomy/celestial.h"
#include "sunlit/astronomy/moon_position.h"
#include "sunlit/astronomy/star_catalogue.h"
#include "sunlit/astronomy/sun_position.h"
#include "sunlit/light/land.h"

namespace sunlit::studio {
namespace {

/// At a time: conditions of one run may have sites of their own. More, where there are as many states of the
/// ground: under a moving sky each has its turn before the first is asked for again.
constexpr std::size_t kUsualAirs = 8;

/// With the ground that is fixed, if one is.
SkyOptions checked(SkyOptions options) {
  options.air.ground_albedo = options.fixed_ground_albedo.value_or(options.air.ground_albedo);
  sky::AtmosphereOptions air = options.air;
  air.observer_height_m = options.fixed_height_m.value_or(0.0);
  sky::validate(air);
  return options;
}

}  // namespace

SkyBodies bodiesAt(const Instant& instant, const Site& site, const Air& air,
                   const astronomy::EarthRotation& earth) {
  const astronomy::SolarCoordinates solar = astronomy::solarCoordinates(instant, earth);
  const astronomy::SunPosition sun = astronomy::sunPosition(solar, site, air);
  const astronomy::MoonPosition moon =
      astronomy::moonPosition(astronomy::lunarCoordinates(instant, earth), solar, site, air);
  SkyBodies bodies;
  bodies.sun = {sun.direction(), solar.distance_au, Direction(sun.azimuth, sun.elevation_geometric)};
  bodies.moon =
      sky::MoonInSky{moon.direction(), moon.geometricDirection(), moon.distance_m, moon.phase_angle};
  bodies.map_from_celestial = astronomy::mapFromCelestial(instant, earth, site);
  bodies.site_elevation_m = site.elevation_m;
  return bodies;
}

std::shared_ptr<const std::vector<sky::Star>> loadStars(const Reports& reports) {
  const astronomy::StarCatalogue catalogue = astronomy::readStarCatalogue();
  for (const std::string& warning : catalogue.warnings) tellFlaw(reports, warning);
  auto stars = std::make_shared<std::vector<sky::Star>>();
  stars->reserve(catalogue.stars.size());
  for (const astronomy::CatalogueStar& star : catalogue.stars)
    stars->push_back({star.towards.cast<float>(), sky::starIlluminance(star.v_magnitude, star.b_minus_v)});
  return stars;
}

Sky::Sky(const SkyOptions& options, Reports reports)
    : options_(checked(options)),
      reports_(std::move(reports)),
      air_tables_(options.cache_dir.empty() ? sky::TableStore() : airTablesIn(options.cache_dir, reports_)),
      stars_(options.stars ? loadStars(reports_) : nullptr),
      ground_albedos_{options_.air.ground_albedo} {}

void Sky::over(const std::vector<light::World>& states) {
  ground_albedos_.clear();
  for (const light::World& world : states) {
    std::string origin = "as given";
    double albedo = options_.air.ground_albedo;
    if (!options_.fixed_ground_albedo) {
      const std::optional<double> seen = light::albedoFromAbove(world);
      origin = seen ? "the mean of the world from above" : "as nothing of the world is seen from above";
      albedo = seen.value_or(sky::AtmosphereOptions().ground_albedo);
    }
    ground_albedos_.push_back(albedo);
    tell(reports_.note, "Albedo of the land beyond the world: " + textOf(albedo) + ", " + origin);
  }
  airs_.clear();
}

sky::Daylight Sky::daylight(const SkyBodies& bodies, const sky::Weather& weather, std::size_t state) {
  return airOver(bodies.site_elevation_m, state)
      .daylight(bodies.sun, {bodies.moon, bodies.map_from_celestial, stars_}, weather);
}

sky::AtmosphereOptions airOf(const SkyOptions& options, double site_elevation_m) {
  sky::AtmosphereOptions air = options.air;
  const std::vector<Field> rows = fieldsOf(air);
  const Range& allowed = fieldOf(rows, "observer_height").range;
  air.observer_height_m =
      options.fixed_height_m.value_or(std::clamp(site_elevation_m, allowed.low, allowed.high));
  return air;
}

void Sky::requireWeather(const sky::Weather& weather, double site_elevation_m) const {
  sky::validate(weather, airOf(options_, site_elevation_m));
}

sky::AtmosphereOptions Sky::airAt(double site_elevation_m, std::size_t state) const {
  sky::AtmosphereOptions air = airOf(options_, site_elevation_m);
  air.ground_albedo = groundAlbedo(state);
  return air;
}

bool Sky::isPrepared(double site_elevation_m, std::size_t state) const {
  const sky::AtmosphereOptions wanted = airAt(site_elevation_m, state);
  return std::any_of(airs_.begin(), airs_.end(), [&](const Air& air) { return air.isOf(wanted); });
}

const sky::Atmosphere& Sky::airOver(double site_elevation_m, std::size_t state) {
  const sky::AtmosphereOptions wanted = airAt(site_elevation_m, state);
  const auto known =
      std::find_if(airs_.begin(), airs_.end(), [&](const Air& air) { return air.isOf(wanted); });
  if (known != airs_.end()) {
    std::rotate(known, known + 1, airs_.end());
    return airs_.back().atmosphere;
  }
  tell(reports_.note, "Air of a height of " + textOf(wanted.observer_height_m) + " m");
  if (airs_.size() == std::max(kUsualAirs, ground_albedos_.size() + 1)) airs_.erase(airs_.begin());
  airs_.push_back({wanted.observer_height_m, wanted.ground_albedo, sky::Atmosphere(wanted, air_tables_)});
  return airs_.back().atmosphere;
}

}  // namespace sunlit::studio
