#include "sunlit/sky/atmosphere.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "moonlight.h"
#include "sky_table.h"
#include "stars.h"
#include "sunlit/quantity/turn.h"
#include "sunlit/sky/eclipse.h"

namespace sunlit::sky {
namespace {

/// The disc in level slices: each is dimmed by its own air, and the horizon cuts it off.
Spectrum passedOfDisc(const RadiativeTransfer& transfer, double altitude_km, const DiscLight& disc) {
  const double elevation_rad = disc.towards.elevation().rad();
  const double radius_rad = disc.angular_radius.rad();
  constexpr int kSlices = 16;
  Spectrum sum = Spectrum::Zero();
  double area = 0.0;
  for (int i = 0; i < kSlices; ++i) {
    const double height = 2.0 * (i + 0.5) / kSlices - 1.0;
    const double share = std::sqrt(1.0 - height * height);
    area += share;
    const double low = elevation_rad + radius_rad * (height - 1.0 / kSlices);
    const double high = elevation_rad + radius_rad * (height + 1.0 / kSlices);
    const double above = std::clamp(high / (high - low), 0.0, 1.0);
    if (above > 0.0) {
      const double middle = std::min(0.5 * (std::max(low, 0.0) + high), 0.5 * kPi);
      sum += transfer.transmittance(altitude_km, std::sin(middle)) * static_cast<float>(share * above);
    }
  }
  return sum / static_cast<float>(area);
}

LinearRgb discIlluminance(const RadiativeTransfer& transfer, double altitude_km, const DiscLight& disc,
                          const Spectrum& strength) {
  return inGamut(colourOf(passedOfDisc(transfer, altitude_km, disc) * strength));
}

MediumParameters mediumOf(const AtmosphereOptions& options) {
  MediumParameters parameters;
  parameters.turbidity = options.turbidity;
  parameters.ozone_du = options.ozone_du;
  parameters.ground_albedo = options.ground_albedo;
  return parameters;
}

/// Extinction of the clear air at a height, 1/km.
Eigen::Array3f hazePerKm(const Medium& medium, double altitude_km) {
  const LinearRgb clear = colourOf((medium.at(altitude_km).extinction * -1.0F).exp());
  const LinearRgb white = colourOf(Spectrum::Ones());
  return -(clear.value / white.value).log();
}

/// The same by luminance, 1/m.
float hazePerMetre(const Eigen::Array3f& haze_per_km) {
  return LinearRgb(haze_per_km).luminance() * 1e-3F;
}

// By day the moon's sky is at most 3e-5 of the sun's, and the night's glow at most 3e-6.
constexpr double kMoonSkyDrowned = 0.17;  // sine of 10°
constexpr double kGlowDrowned = 0.0;

/// Sunlight above the air, relative to that at 1 AU.
struct SunStrength {
  double disc;  ///< of what is seen of it
  double sky;   ///< that lights the air
};

SunStrength strengthOf(const SunInSky& sun, const NightSky& night) {
  const double alone = 1.0 / (sun.distance_au * sun.distance_au);
  if (!night.moon) return {alone, alone};
  const double uncovered = uncoveredSunlight(sunBehindMoon(sun, *night.moon));
  return {alone * uncovered, alone * (uncovered + kSkyInTotality * (1.0 - uncovered))};
}

Spectrum evenly(double strength) {
  return Spectrum::Constant(static_cast<float>(strength));
}

/// The moon where it covers some of the sun. Refraction, which presses both alike, must not move them apart.
std::optional<DiscCover> coverOf(const SunInSky& sun, const NightSky& night) {
  if (!night.moon || !sunBehindMoon(sun, *night.moon).touch()) return std::nullopt;
  const Eigen::Vector3d to_moon = night.moon->geometric.value_or(night.moon->apparent).vector();
  const Eigen::Vector3d to_sun = sun.geometric.value_or(sun.apparent).vector();
  return DiscCover{Direction(turnBetween(to_sun, sun.apparent.vector()) * to_moon),
                   moonAngularRadius(*night.moon)};
}

/// Of a lamp's elevation without refraction.
template <typename Lamp>
float sineOf(const Lamp& lamp) {
  return static_cast<float>(lamp.geometric.value_or(lamp.apparent).vector().z());
}

}  // namespace

struct Atmosphere::Tables {
  Tables(const AtmosphereOptions& options, const TableStore& kept)
      : altitude_km(options.observer_height_m * 1e-3),
        transfer(mediumOf(options), kept),
        extinction(transfer, altitude_km),
        glow(transfer, extinction),
        sights(std::make_shared<AirSights>(transfer, altitude_km)),
        store(kept) {}

  double altitude_km;
  RadiativeTransfer transfer;
  Extinction extinction;
  NightGlow glow;
  std::shared_ptr<const AirSights> sights;
  TableStore store;
  // Made when weather first needs them:
  mutable std::once_flag weather_once;
  mutable std::unique_ptr<const Droplets> droplets;
  mutable float clear_at_horizon_lx = 0.0F;
  mutable CloudMaps clouds;
};

void validate(const AtmosphereOptions& options) {
  requireFields(options);
}

void validate(const Weather& weather, const AtmosphereOptions& air) {
  validate(weather);
  validate(air);
  if (!weather.visibility_m) return;
  const Eigen::Array3f haze_per_km = hazePerKm(Medium(mediumOf(air)), 1e-3 * air.observer_height_m);
  fogPerMetre(*weather.visibility_m, static_cast<double>(hazePerMetre(haze_per_km)));
}

Atmosphere::Atmosphere(const AtmosphereOptions& options, const TableStore& kept) {
  validate(options);
  tables_ = std::make_unique<const Tables>(options, kept);
}

Atmosphere::~Atmosphere() = default;
Atmosphere::Atmosphere(Atmosphere&&) noexcept = default;
Atmosphere& Atmosphere::operator=(Atmosphere&&) noexcept = default;

Daylight Atmosphere::daylight(const SunInSky& sun, const NightSky& night, const Weather& weather) const {
  require("distance_au", sun.distance_au, {0.97, 1.03}, "AU");
  const Tables& tables = *tables_;
  const Direction sun_lights = sun.geometric.value_or(sun.apparent);
  const double sun_height = sun_lights.vector().z();
  auto table = std::make_shared<SkyTable>();
  table->sights = tables.sights;

  table->sun.towards = sun.apparent;
  table->sun.angular_radius = sunAngularRadius(sun.distance_au);
  table->sun.cover = coverOf(sun, night);
  const SunStrength strength = strengthOf(sun, night);
  table->sun.illuminance =
      discIlluminance(tables.transfer, tables.altitude_km, table->sun, evenly(strength.disc));
  if (sun_height > DiffuseLight::kLowestSun) {
    const AirLamp lamp{sun.apparent, sun_lights, evenly(strength.sky)};
    table->sun_sky.emplace(tables.transfer, tables.altitude_km, lamp);
    table->sun_air.emplace(tables.transfer, *tables.sights, lamp);
  }
  if (night.moon) {
    addMoon(*night.moon, sun, table.get());
  }
  if (sun_height < kGlowDrowned) {
    table->glow = tables.glow.sky(night, sun_lights);
  }
  table->stars = starsAbove(night, tables.extinction);
  table->haze_per_km = hazePerKm(tables.transfer.medium(), tables.altitude_km);
  validate(weather);
  if (!isClear(weather)) addWeather(weather, {sun, night}, table.get());
  gatherIlluminance(static_cast<float>(tables.transfer.medium().parameters().ground_albedo), table.get());
  return Daylight(std::move(table));
}

void Atmosphere::makeForWeather() const {
  tables_->droplets = std::make_unique<const Droplets>(tables_->store);
  const Direction east(Azimuth::degrees(90.0), Angle());
  tables_->clear_at_horizon_lx = daylight({east, 1.0}).skyIlluminance(Eigen::Vector3f::UnitZ()).luminance();
}

void Atmosphere::addWeather(const Weather& weather, const Lamps& lamps, SkyTable* table) const {
  const Tables& tables = *tables_;
  // By itself: a thread that waits for the loops within would else take up another daylight, and come here.
  std::call_once(tables.weather_once, [&] { tbb::this_task_arena::isolate([&] { makeForWeather(); }); });
  CieLevels levels;
  levels.clear_at_horizon_lx = tables.clear_at_horizon_lx;
  levels.sun = {static_cast<float>(strengthOf(lamps.sun, lamps.night).sky), sineOf(lamps.sun)};
  if (lamps.night.moon) {
    const auto strength =
        static_cast<double>(colourOf(moonStrength(*lamps.night.moon, lamps.sun)).luminance());
    levels.moon = {static_cast<float>(strength / kLuminousSolarConstant_lx), sineOf(*lamps.night.moon)};
  }
  const WeatherTables made_of{*tables.droplets, isBroken(weather) ? tables.clouds.of(weather) : nullptr,
                              levels, static_cast<float>(tables.transfer.medium().parameters().ground_albedo),
                              hazePerMetre(table->haze_per_km)};
  const auto made = std::make_shared<const WeatherSky>(weather, made_of, *table);
  const auto dim = [&](DiscLight* disc, LinearRgb* above_fog) {
    const auto z = static_cast<float>(disc->towards.vector().z());
    *above_fog = disc->illuminance * made->passedCover(z);
    disc->illuminance = disc->illuminance * made->passed(z);
  };
  dim(&table->sun, &table->sun_above_fog);
  dim(&table->moon, &table->moon_above_fog);
  for (PointLight& star : table->stars)
    star.illuminance = star.illuminance * made->passedCover(star.towards.z());
  table->weather = made;
}

void Atmosphere::addMoon(const MoonInSky& moon, const SunInSky& sun, SkyTable* table) const {
  validate(moon);
  const Direction sun_lights = sun.geometric.value_or(sun.apparent);
  const Direction lights = moon.geometric.value_or(moon.apparent);
  const Spectrum strength = moonStrength(moon, sun);
  table->moon.towards = moon.apparent;
  table->moon.angular_radius = moonAngularRadius(moon);
  table->moon.lit_from = moonLitFrom(moon, sun_lights);
  table->moon.illuminance = discIlluminance(tables_->transfer, tables_->altitude_km, table->moon, strength);
  if (strength.maxCoeff() > 0.0F && lights.vector().z() > DiffuseLight::kLowestSun &&
      sun_lights.vector().z() < kMoonSkyDrowned) {
    const AirLamp lamp{moon.apparent, lights, strength};
    table->moon_sky.emplace(tables_->transfer, tables_->altitude_km, lamp);
    table->moon_air.emplace(tables_->transfer, *tables_->sights, lamp);
  }
}

}  // namespace sunlit::sky
