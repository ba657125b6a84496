// The error of the fast picture's light, view by view and sun by sun.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>

#include "sunlit/image/files.h"
#include "sunlit/image/flip.h"
#include "sunlit/light/land.h"
#include "sunlit/path/path.h"
#include "sunlit/quantity/duration.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/sky/atmosphere.h"
#include "sunlit/studio/command_line.h"
#include "tools/compare_light_options.h"
#include "tools/comparison_files.h"
#include "tools/every_nth_pixel.h"
#include "tools/path_arguments.h"
#include "tools/terminal.h"

namespace sunlit::tools {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<Eigen::Isometry3d> viewsOf(const CompareLightOptions& options) {
  if (!options.map_from_camera.empty()) return options.map_from_camera;
  const std::vector<Eigen::Isometry3d> poses = path::posesAlong(waypointsOf(options.path), options.sampling);
  std::vector<Eigen::Isometry3d> views;
  for (int i = 0; i < options.views; ++i) {
    views.push_back(
        poses[poses.size() * static_cast<std::size_t>(i) / static_cast<std::size_t>(options.views)]);
  }
  return views;
}

sky::Daylight daylightOf(const SkyToCompare& what, const sky::Weather& weather,
                         const sky::Atmosphere& atmosphere) {
  const Direction towards(Azimuth::degrees(what.azimuth_deg), Angle::degrees(what.elevation_deg));
  if (!what.moon_phase_deg) return atmosphere.daylight({towards, 1.0}, {}, weather);
  constexpr double kDeepNight_deg = -40.0;
  const Direction sun(Azimuth::degrees(what.azimuth_deg + 180.0), Angle::degrees(kDeepNight_deg));
  sky::NightSky night;
  night.moon.emplace();
  night.moon->apparent = towards;
  night.moon->phase_angle = Angle::degrees(*what.moon_phase_deg);
  return atmosphere.daylight({sun, 1.0}, night, weather);
}

class Comparer {
 public:
  Comparer(const CompareLightOptions& options, const light::World& world)
      : options_(options), world_(world), renderer_(world, options.render) {
    sky::AtmosphereOptions air;
    air.ground_albedo = light::albedoFromAbove(world).value_or(air.ground_albedo);
    std::printf("albedo of the land beyond the world: %.3f\n", air.ground_albedo);
    const sky::Atmosphere atmosphere(air);
    for (const SkyToCompare& what : options.skies)
      days_.push_back(daylightOf(what, options.weather, atmosphere));
  }

  void compare(int view, const Eigen::Isometry3d& map_from_camera) {
    renderer_.look(map_from_camera * linkFromOptical());
    const EveryNthPixel chosen(options_.every);
    const light::Surfaces surfaces = chosen.of(renderer_.surfaces());
    const std::vector<light::Traced> traced = trace(surfaces);
    const std::size_t first = rows_.size();
    for (std::size_t i = 0; i < days_.size(); ++i) {
      const image::LinearImage fast = renderer_.light(light::illumination(world_, days_[i], options_.lamps));
      const image::Picture<float, 1> errors = light::relativeErrors(fast, traced[i], surfaces);
      const std::string& name = options_.skies[i].name;
      rows_.push_back({view, name, static_cast<double>(days_[i].groundIlluminance().luminance()),
                       light::luminanceError(fast, traced[i], surfaces),
                       image::meanOf(image::hdrFlip(chosen.of(traced[i].luminance), chosen.of(fast)))});
      by_material_.add(surfaces, errors);
      image::writePng(options_.output + "/view_" + std::to_string(view) + "_" + name + ".png",
                      sideBySide(chosen.of(fast), chosen.of(traced[i].luminance), chosen.of(errors)));
    }
    if (rows_[first].error.pixels == 0)
      std::fprintf(stderr, "warning: view %d has no pixel that is compared and sees a surface\n", view);
    by_material_.write(options_.output, *world_.geometry->scene);
    writeTables(options_.output, rows_);
  }

  const std::vector<ComparisonRow>& rows() const { return rows_; }

 private:
  /// One a day: those on which lamps burn apart from the others.
  std::vector<light::Traced> trace(const light::Surfaces& surfaces) const {
    std::vector<std::size_t> numbers[2];
    for (std::size_t i = 0; i < days_.size(); ++i)
      numbers[light::burnUnder(options_.lamps, days_[i]) ? 1 : 0].push_back(i);
    std::vector<light::Traced> all(days_.size());
    for (std::size_t burn = 0; burn < 2; ++burn) {
      if (numbers[burn].empty()) continue;
      std::vector<sky::Daylight> days;
      for (const std::size_t i : numbers[burn]) days.push_back(days_[i]);
      light::ReferenceOptions reference = options_.reference;
      if (burn == 1) reference.lamps = light::burning(world_.geometry->scene->lamps, options_.lamps);
      std::vector<light::Traced> some = light::traceReference(surfaces, world_, days, reference);
      for (std::size_t k = 0; k < some.size(); ++k) all[numbers[burn][k]] = std::move(some[k]);
    }
    return all;
  }

  const CompareLightOptions& options_;
  const light::World& world_;
  render::Renderer renderer_;
  std::vector<sky::Daylight> days_;
  std::vector<ComparisonRow> rows_;
  ErrorByMaterial by_material_;
};

/// Nothing where none of `rows` has pixels.
std::optional<double> worstOf(const std::vector<ComparisonRow>& rows) {
  std::optional<double> worst;
  for (const ComparisonRow& row : rows) {
    if (row.error.pixels > 0) worst = std::max(worst.value_or(0.0), row.error.mean);
  }
  return worst;
}

void tellProgress(std::size_t done, std::size_t views, double elapsed_s, std::optional<double> worst) {
  const double left_s = elapsed_s / static_cast<double>(done) * static_cast<double>(views - done);
  char text[64] = "no surface seen so far";
  if (worst) std::snprintf(text, sizeof text, "worst mean error so far %.1f %%", 100.0 * *worst);
  std::printf("view %zu of %zu: %s, %s left\n", done, views, text, textOfDuration(left_s).c_str());
  std::fflush(stdout);
}

void run(const CompareLightOptions& options) {
  image::makeFolder(options.output);
  const auto load_start = Clock::now();
  const light::World dry =
      studio::loadWorld(options.world, studio::cacheOf(options.bake).folder, std::nullopt, onTerminal());
  light::World world = light::weathered(dry, options.surfaces);
  studio::requireGroups(world, options.lamps, onTerminal());
  world.transport = studio::bake(world, options.bake, onTerminal());
  std::printf("world loaded and its light baked or read in %.1f s\n", secondsSince(load_start));
  const std::vector<Eigen::Isometry3d> views = viewsOf(options);
  Comparer comparer(options, world);
  const auto start = Clock::now();
  for (std::size_t i = 0; i < views.size(); ++i) {
    comparer.compare(static_cast<int>(i), views[i]);
    tellProgress(i + 1, views.size(), secondsSince(start), worstOf(comparer.rows()));
  }
  if (!worstOf(comparer.rows()))
    throw std::runtime_error(
        "no view has a pixel that is compared and sees a surface: there is no error to tell of");
  std::printf("%s/table.md\n", options.output.c_str());
}

}  // namespace
}  // namespace sunlit::tools

int main(int argc, char** argv) {
  using namespace sunlit::tools;
  return sunlit::studio::runProgram({"compare_light", argc, argv}, parseCompareLightOptions, run);
}
