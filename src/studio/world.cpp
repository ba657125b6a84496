#include "sunlit/studio/world.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>

#include "studio/kept_track.h"
#include "studio/tell.h"
#include "sunlit/image/cache_folder.h"
#include "sunlit/light/lamp_surroundings.h"
#include "sunlit/light/lamps.h"
#include "sunlit/quantity/comma_list.h"
#include "sunlit/quantity/memory.h"
#include "sunlit/quantity/range.h"

namespace sunlit::studio {
namespace {

void tellOf(const WorldOptions& options, const scene::Scene& scene, const std::string& size,
            const Reports& reports) {
  for (const std::string& warning : scene.warnings) tellFlaw(reports, options.name + ": " + warning);
  const auto through = std::count_if(scene.lamps.begin(), scene.lamps.end(),
                                     [](const scene::Lamp& lamp) { return !lamp.casts_shadows; });
  tell(reports.note, "World " + options.name + ": " + size + ", " + std::to_string(scene.textures.size()) +
                         " textures, " + std::to_string(scene.lamps.size()) + " lamps" +
                         (through > 0 ? ", " + std::to_string(through) +
                                            " of them without shadows, as it says: they shine through walls"
                                      : ""));
}

std::string countOf(std::size_t triangles) {
  return std::to_string(triangles) + " triangles";
}

Eigen::AlignedBox3f boxAround(const scene::Shape& shape) {
  Eigen::AlignedBox3f box;
  for (const scene::Chunk& chunk : shape.chunks) box.extend(chunk.box);
  return box;
}

/// In short.
std::string metresOf(double length_m) {
  return std::abs(length_m) < 100.0 ? sunlit::textOf(length_m, 3) : sunlit::textOf(std::round(length_m));
}

std::string sizeOf(const scene::Shape& shape) {
  const Eigen::AlignedBox3f box = boxAround(shape);
  const Eigen::Vector3f sizes = box.sizes();
  std::string extents;
  for (const float extent : sizes)
    extents += (extents.empty() ? " in " : " x ") + metresOf(static_cast<double>(extent));
  return countOf(shape.triangles.size()) + (box.isEmpty() ? "" : extents + " m");
}

void tellOfHousings(const WorldOptions& options, const std::vector<std::string>& lamps,
                    const Reports& reports) {
  if (lamps.empty()) return;
  tellFlaw(reports, options.name + ": " + std::to_string(lamps.size()) +
                        " lamps stand within something opaque all around, and shine through it: " +
                        lamps.front() + (lamps.size() > 1 ? "; …" : ""));
}

/// For inMemory().
std::string loading(const WorldOptions& options) {
  return "loading the world " + options.name;
}

light::World flatWorld(const WorldOptions& options, const std::string& cache_folder,
                       const std::optional<scene::Robot>& robot, const Reports& reports) {
  scene::FlatScene flat = options.name == scene::kRaceTrack
                              ? keptRaceTrack(cache_folder, reports)
                              : scene::flattened(scene::load(options.name, options.searchPath()));
  tellOf(options, flat.scene, sizeOf(flat.shape), reports);
  const auto scene = std::make_shared<scene::Scene>(std::move(flat.scene));
  std::vector<std::vector<scene::Mesh>> meshes_of_links;
  if (robot) meshes_of_links = scene::addLooks(*robot, scene.get());
  light::World world(scene, std::make_shared<const scene::Shape>(std::move(flat.shape)), meshes_of_links);
  // Those of the built-in world are made to fit.
  if (options.name != scene::kRaceTrack)
    tellOfHousings(options, light::fitToSurroundings(world, &scene->lamps), reports);
  if (robot) {
    for (const scene::RobotLink& link : robot->links) world.lamps_of_bodies.push_back(link.lamps);
  }
  return world;
}

}  // namespace

scene::SearchPath WorldOptions::searchPath() const {
  scene::SearchPath path = scene::SearchPath::withEnvironment(model_path);
  path.missing = missing;
  return path;
}

std::string requireWorld(const WorldOptions& options) {
  return scene::requireWorld(options.name, options.searchPath());
}

scene::Scene loadScene(const WorldOptions& options, const Reports& reports) {
  scene::Scene scene =
      inMemory(loading(options), [&] { return scene::load(options.name, options.searchPath()); });
  tellOf(options, scene, countOf(scene.triangleCount()), reports);
  return scene;
}

light::World loadWorld(const WorldOptions& options, const std::string& cache_folder,
                       const std::optional<scene::Robot>& robot, const Reports& reports) {
  return inMemory(loading(options), [&] { return flatWorld(options, cache_folder, robot, reports); });
}

std::string sizeOf(const light::World& world) {
  return sizeOf(*world.geometry->shape);
}

Eigen::AlignedBox3d boundsOf(const light::World& world) {
  return boxAround(*world.geometry->shape).cast<double>();
}

std::string reachOf(const Eigen::AlignedBox3d& bounds) {
  if (bounds.isEmpty()) return "which has nothing that stands still";
  const auto corner = [](const Eigen::Vector3d& point) {
    return metresOf(point.x()) + "," + metresOf(point.y()) + "," + metresOf(point.z());
  };
  return "which reaches from " + corner(bounds.min()) + " to " + corner(bounds.max()) + " m";
}

bool isFarFrom(const Eigen::AlignedBox3d& bounds, const Eigen::Vector3d& place, double far_m) {
  constexpr double kSizes = 10.0;
  return !bounds.isEmpty() &&
         bounds.exteriorDistance(place) > std::min(far_m, kSizes * bounds.diagonal().norm());
}

void requireGroups(const light::World& world, const light::LampOptions& lamps, const Reports& reports) {
  std::set<std::string> groups;
  const auto note = [&](const std::vector<scene::Lamp>& those) {
    for (const scene::Lamp& lamp : those) groups.insert(lamp.group);
  };
  note(world.geometry->scene->lamps);
  for (const std::vector<scene::Lamp>& of_body : world.lamps_of_bodies) note(of_body);
  for (const std::string& group : lamps.off) {
    if (groups.count(group) == 0)
      refuse("lamps_off", group,
             groups.empty() ? "left out: there are no lamps" : "one of " + commaList(groups));
  }
  std::set<std::pair<std::string, bool>> sets;
  for (const scene::Lamp& lamp : world.geometry->scene->lamps) sets.emplace(lamp.group, lamp.relative);
  if (!lamps.off.empty() && sets.size() > light::kMostLampSets) {
    tellFlaw(reports, "there are " + std::to_string(sets.size()) +
                          " groups of lamps: lamps_off switches what surfaces pass on of the light of all "
                          "but the first " +
                          std::to_string(light::kMostLampSets - 1) + " as one, by the share that burns");
  }
}

light::BakeCache cacheOf(const BakeOptions& options) {
  return {options.cache_dir.empty() ? image::usualCacheFolder() : options.cache_dir,
          static_cast<std::uintmax_t>(1e9 * options.cache_limit_gb)};
}

std::shared_ptr<const light::Transport> bake(const light::World& world, const BakeOptions& options,
                                             const Reports& reports) {
  if (!options.enabled) return nullptr;
  const light::BakeCache cache = cacheOf(options);
  auto transport = inMemory("baking the light of a world", [&] {
    return light::Transport::cached(world.geometry, options.transport, cache,
                                    {reports.baking, reports.warning, reports.note, reports.check});
  });
  tell(reports.note, "Sky light and bounced light at " + std::to_string(transport->sampleCount()) +
                         " samples, kept in " + cache.folder);
  return transport;
}

}  // namespace sunlit::studio
