#include "sunlit/light/transport.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "light/mirror_sky.h"
#include "light/transport/gather.h"
#include "light/transport/relight.h"
#include "light/transport/scene_samples.h"

namespace sunlit::light {
namespace {

void requireWithin(const char* key, double value, double low, double high) {
  if (value >= low && value <= high) return;
  std::ostringstream message;
  message << key << ": " << value << " is outside " << low << " … " << high;
  throw std::invalid_argument(message.str());
}

/// Where the nodes are all but shut, their light tells little of an open place nearby.
constexpr float kLeastOpen = 0.02f;
constexpr float kMostOpen = 8.0f;

/// Barycentric coordinates in triangle `t` of the point of its plane nearest to `position`, within it.
std::array<float, 3> barycentric(const Geometry& geometry, std::uint32_t t, const Eigen::Vector3f& position) {
  const auto& corners = geometry.triangles[t];
  const Eigen::Vector3f a = geometry.positions[corners[0]];
  const Eigen::Vector3f ab = geometry.positions[corners[1]] - a;
  const Eigen::Vector3f ac = geometry.positions[corners[2]] - a;
  const Eigen::Vector3f ap = position - a;
  const float bb = ab.squaredNorm(), cc = ac.squaredNorm(), bc = ab.dot(ac);
  const float pb = ap.dot(ab), pc = ap.dot(ac);
  const float determinant = std::max(bb * cc - bc * bc, 1e-30f);
  float v = std::max((cc * pb - bc * pc) / determinant, 0.0f);
  float w = std::max((bb * pc - bc * pb) / determinant, 0.0f);
  const float sum = v + w;
  if (sum > 1.0f) v /= sum, w /= sum;
  return {std::max(1.0f - v - w, 0.0f), v, w};
}

}  // namespace

void validate(const TransportOptions& options) {
  requireWithin("rays_per_patch", options.rays_per_patch, 1, 64);
  requireWithin("bounces", options.bounces, 0, 8);
  requireWithin("finest_m", options.finest_m, 0.02, 10.0);
  requireWithin("samples", options.samples, 1000, 1e7);
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
  RefineLimits limits;
  limits.finest_m = static_cast<float>(options.finest_m);
  limits.nodes = static_cast<std::size_t>(options.samples);
  const BakeScene scene{*geometry, rays, traits};
  constexpr double kLeaves = 0.2, kSampled = 0.4;
  auto data = std::make_unique<TransportData>();
  data->leaves = leafOpenness(geometry, traits, [&](double share) { report(kLeaves * share); });
  SceneSamples samples =
      sampleScene(scene, limits, [&](double share) { report(kLeaves + (kSampled - kLeaves) * share); });
  const GatherOptions gather{options.rays_per_patch, options.bounces,
                             [&](double share) { report(kSampled + (1.0 - kSampled) * share); }};
  samples.mesh.drop(gatherLight(scene, samples, gather, data.get()));
  data->mesh = std::move(samples.mesh);
  return std::make_shared<const Transport>(std::move(geometry), std::move(data));
}

Transport::Transport(std::shared_ptr<const Geometry> geometry, std::unique_ptr<const TransportData> data)
    : geometry_(std::move(geometry)), data_(std::move(data)) {
  if (!data_->leaves.first.empty()) open_ = nodeOpenness(*data_);
}
Transport::~Transport() = default;

LightPlace Transport::placeOf(std::uint32_t triangle, bool front, const Eigen::Vector3f& position) const {
  LightPlace light;
  const std::uint32_t root = data_->mesh.roots[triangle][front ? 0 : 1];
  if (root == LightMesh::kNone) return light;
  const std::array<float, 3> within = barycentric(*geometry_, triangle, position);
  const LightMesh::Place place = data_->mesh.locate(root, within);
  light.node = place.node;
  light.weight = place.weight;
  if (!data_->leaves.known(triangle)) return light;
  float at_nodes = 0.0f;
  for (std::size_t k = 0; k < 3; ++k) at_nodes += place.weight[k] * open_[place.node[k]];
  const float here = data_->leaves.at(triangle, front ? 0 : 1, within);
  light.open = std::min(here / std::max(at_nodes, kLeastOpen), kMostOpen);
  return light;
}

void Transport::locate(Surfaces* surfaces) const {
  const scene::Scene& scene = *geometry_->scene;
  tbb::parallel_for(std::size_t{0}, surfaces->tiles.size(), [&](std::size_t i) {
    for (Surface& surface : surfaces->tiles[i].surfaces) {
      surface.light = surface.behind = LightPlace();
      if (surface.triangle >= geometry_->triangles.size()) continue;  // a body that moves: see BodyLight
      const bool front = geometry_->planes[surface.triangle].normal.dot(surface.geometric_normal) > 0.0f;
      surface.light = placeOf(surface.triangle, front, surface.position);
      if (scene.materials[static_cast<std::size_t>(surface.material)].transmission > 0.0f)
        surface.behind = placeOf(surface.triangle, !front, surface.position);
    }
    findMirrorViews(*data_, scene, surfaces->width, &surfaces->tiles[i]);
  });
}

std::vector<Eigen::Array3f> Transport::irradiance(const sky::Daylight& day) const {
  return relight(*data_, day).irradiance;
}

Illumination Transport::illumination(const sky::Daylight& day) const {
  NodeLight nodes = relight(*data_, day);
  Illumination light(day);
  light.irradiance = std::make_shared<const std::vector<Eigen::Array3f>>(std::move(nodes.irradiance));
  light.surroundings = std::make_shared<const std::vector<Eigen::Array3f>>(std::move(nodes.surroundings));
  light.mirror_sky = std::make_shared<const MirrorSky>(day);
  return light;
}

std::size_t Transport::sampleCount() const {
  return data_->tints.size();
}
std::size_t Transport::nodeCount() const {
  return data_->mesh.nodeCount();
}

}  // namespace sunlit::light
