#include "sunlit/light/transport.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <optional>
#include <stdexcept>

#include "light/bake/gather/gather.h"
#include "light/bake/gather/relight.h"
#include "light/bake/samples/scene_samples.h"
#include "light/geometry/corners.h"
#include "light/patches/mirror_sky.h"
#include "light/patches/sky_sectors.h"
#include "light/picture/mirror/find_mirrors.h"
#include "sunlit/light/final_gather.h"

namespace sunlit::light {
void validate(const TransportOptions& options) {
  requireFields(options);
}

std::shared_ptr<const Transport> Transport::bake(std::shared_ptr<const Geometry> geometry,
                                                 const TransportOptions& options,
                                                 const BakeProgress& progress) {
  validate(options);
  const auto start = std::chrono::steady_clock::now();
  const auto report = [&](double share) {
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    if (progress) progress(share, share > 0.0 ? taken.count() * (1.0 - share) / share : 0.0);
  };
  const BakeRays rays(geometry);
  const std::vector<TriangleTraits> traits = triangleTraits(*geometry, rays);
  const RefineLimits limits{static_cast<float>(options.finest_m), static_cast<std::size_t>(options.samples)};
  const BakeScene scene{*geometry, rays, traits};
  const ShiningSurfaces shining(*geometry, rays, traits);
  constexpr double kLeaves = 0.2, kSampled = 0.4;
  auto data = std::make_unique<TransportData>();
  SceneSamples samples;
  std::mutex mutex;
  double leaves = 0.0, sampled = 0.0;
  const auto note = [&](double share, double* part) {
    const std::lock_guard<std::mutex> lock(mutex);
    *part = share;
    report(kLeaves * leaves + (kSampled - kLeaves) * sampled);
  };
  // Side by side, since some of the sampling is work for one thread.
  tbb::parallel_invoke(
      [&] { data->leaves = leafOpenness(geometry, traits, [&](double share) { note(share, &leaves); }); },
      [&] { samples = sampleScene(scene, shining, limits, [&](double share) { note(share, &sampled); }); });
  const GatherOptions gather{options.rays_per_patch, options.bounces, shining,
                             [&](double share) { report(kSampled + (1.0 - kSampled) * share); }};
  samples.mesh.drop(gatherLight(scene, samples, gather, data.get()));
  data->mesh = std::move(samples.mesh);
  return std::make_shared<const Transport>(std::move(geometry), options, std::move(data));
}

Transport::Transport(std::shared_ptr<const Geometry> geometry, const TransportOptions& options,
                     std::unique_ptr<const TransportData> data)
    : geometry_(std::move(geometry)),
      options_(options),
      data_(std::move(data)),
      node_open_(std::make_shared<const std::vector<float>>(openSky(*data_))) {}
Transport::~Transport() = default;

LightPlace Transport::placeOf(std::uint32_t triangle, bool front, const Eigen::Vector3f& position) const {
  return placeWithin(triangle, front, Corners(*geometry_, triangle).within(position));
}

LightPlace Transport::placeWithin(std::uint32_t triangle, bool front,
                                  const std::array<float, 3>& within) const {
  LightPlace light;
  const std::uint32_t root = data_->mesh.roots[triangle][front ? 0 : 1];
  if (root == LightMesh::kSealed && data_->mesh.nodeCount() > 0) {
    light.node.fill(0);
    light.weight.fill(0.0f);
  }
  if (!LightMesh::isCell(root)) return light;
  const LightMesh::Place place = data_->mesh.locate(root, within);
  light.node = place.node;
  light.weight = place.weight;
  return light;
}

void Transport::locate(Surfaces* surfaces, FinalGather* gather) const {
  const scene::Scene& scene = *geometry_->scene;
  tbb::parallel_for(std::size_t{0}, surfaces->tiles.size(), [&](std::size_t i) {
    std::uint32_t last = 0xffffffffu;  // neighbours often lie on one triangle
    std::optional<Corners> corners;
    for (Surface& surface : surfaces->tiles[i].surfaces) {
      surface.light = surface.behind = LightPlace();
      surface.sky = SkyOpenness();
      surface.gathered = Surface::kNotGathered;
      if (surface.triangle >= geometry_->triangles.size()) continue;  // a body that moves: see BodyLight
      const bool front = geometry_->planes[surface.triangle].normal.dot(surface.geometric_normal) > 0.0f;
      if (surface.triangle != last) corners.emplace(*geometry_, last = surface.triangle);
      const std::array<float, 3> within = corners->within(surface.position);
      surface.light = placeWithin(surface.triangle, front, within);
      if (scene.materials[static_cast<std::size_t>(surface.material)].transmission > 0.0f)
        surface.behind = placeWithin(surface.triangle, !front, within);
      if (data_->leaves.known(surface.triangle)) surface.sky = data_->leaves.at(surface.triangle, within);
    }
    surfaces->tiles[i].gathered.clear();
  });
  if (gather) gather->look(surfaces);
  tbb::parallel_for(std::size_t{0}, surfaces->tiles.size(),
                    [&](std::size_t i) { findMirrors(*data_, scene, surfaces->width, &surfaces->tiles[i]); });
}

std::vector<NodeLight> Transport::relight(const sky::Daylight& day, const std::vector<float>& lamp_shares,
                                          const Visibility* visibility) const {
  return light::relight(*data_, {day, lamp_shares, visibility});
}

Illumination Transport::illumination(const sky::Daylight& day, const std::vector<float>& lamp_shares,
                                     const Visibility* visibility) const {
  Illumination light(day);
  light.nodes = std::make_shared<const std::vector<NodeLight>>(relight(day, lamp_shares, visibility));
  light.node_open = node_open_;
  light.sky_sectors = std::make_shared<const SkySectors>(day);
  light.mirror_sky = std::make_shared<const MirrorSky>(day);
  return light;
}

std::size_t Transport::sampleCount() const {
  return data_->sampleCount();
}
std::size_t Transport::nodeCount() const {
  return data_->mesh.nodeCount();
}

}  // namespace sunlit::light
