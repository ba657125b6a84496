/// The light of the whole sky over a place at an instant.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sunlit/astronomy/solar_coordinates.h"
#include "sunlit/light/world.h"
#include "sunlit/quantity/instant.h"
#include "sunlit/quantity/site.h"
#include "sunlit/sky/atmosphere.h"
#include "sunlit/sky/table_store.h"
#include "sunlit/sky/weather.h"
#include "sunlit/studio/reports.h"

namespace sunlit::studio {

/// What is in the sky, seen from a site. Without a moon or the turn of the stars there is none of them.
struct SkyBodies {
  sky::SunInSky sun;
  std::optional<sky::MoonInSky> moon = {};
  std::optional<Eigen::Matrix3d> map_from_celestial = {};
  double site_elevation_m = 0.0;
};

/// Sun, moon and stars as astronomy has them.
SkyBodies bodiesAt(const Instant& instant, const Site& site, const Air& air = {},
                   const astronomy::EarthRotation& earth = {});

/// The stars of the installed catalogue, brightest first; none, and a warning, where there is no catalogue.
/// Throws what astronomy::readStarCatalogue() throws.
std::shared_ptr<const std::vector<sky::Star>> loadStars(const Reports& reports);

struct SkyOptions {
  sky::AtmosphereOptions air;  ///< but for height and ground, which are the next ones
  /// m above sea level, as AtmosphereOptions allows. Nothing: the site's elevation; where that is lower or
  /// higher than allowed, the nearest that is.
  std::optional<double> fixed_height_m;
  /// Nothing: that of the world, see Sky::over(); where there is none, that of sky::AtmosphereOptions.
  std::optional<double> fixed_ground_albedo;
  bool stars = true;
  /// Where tables of the air are kept for the next time; empty: nowhere.
  std::string cache_dir = {};
};

/// The air over a site, but for the ground below it.
sky::AtmosphereOptions airOf(const SkyOptions& options, double site_elevation_m);

/// Makes the tables of the air when they are first needed, which takes two or three seconds where the
/// cache does not have them, says so, and keeps those of the heights that were used last. One thread at a
/// time.
class Sky {
 public:
  /// Reads the stars. Throws as sky::validate() and loadStars().
  explicit Sky(const SkyOptions& options, Reports reports = {});

  /// The land goes on beyond the world as it is seen there from above (light::albedoFromAbove()), in each of
  /// its `states`, unless the options fix its albedo. Says which it is. Forgets the airs that are there.
  void over(const std::vector<light::World>& states);
  double groundAlbedo(std::size_t state = 0) const { return ground_albedos_.at(state); }

  /// Throws std::invalid_argument where the air of a site cannot have this weather, and daylight() would.
  void requireWeather(const sky::Weather& weather, double site_elevation_m) const;

  /// Over the land in its state number `state`.
  sky::Daylight daylight(const SkyBodies& bodies, const sky::Weather& weather = {}, std::size_t state = 0);
  /// Makes the air that daylight() of the same site will need, if it is not there.
  void prepare(double site_elevation_m, std::size_t state = 0) { airOver(site_elevation_m, state); }
  bool isPrepared(double site_elevation_m, std::size_t state = 0) const;

 private:
  /// The options of the air that is needed there.
  sky::AtmosphereOptions airAt(double site_elevation_m, std::size_t state) const;
  const sky::Atmosphere& airOver(double site_elevation_m, std::size_t state);

  SkyOptions options_;
  Reports reports_;
  sky::TableStore air_tables_;
  std::shared_ptr<const std::vector<sky::Star>> stars_;
  std::vector<double> ground_albedos_;  ///< one a state
  struct Air {
    double height_m, ground_albedo;
    sky::Atmosphere atmosphere;

    bool isOf(const sky::AtmosphereOptions& wanted) const {
      return height_m == wanted.observer_height_m && ground_albedo == wanted.ground_albedo;
    }
  };
  std::vector<Air> airs_;  ///< the one that was used last is the last
};

}  // namespace sunlit::studio
