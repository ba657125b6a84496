#include "sunlit/light/transport.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "light/bake/gather/gather.h"
#include "light/bake/gather/lamp_lit.h"
#include "light/bake/gather/relight.h"
#include "light/bake/samples/compact_sources.h"
#include "light/bake/samples/node_lights.h"
#include "light/bake/samples/scene_samples.h"
#include "light/bake/samples/shining_surfaces.h"
#include "light/lamps/lamp_sets.h"
#include "light/patches/mirror_sky.h"
#include "light/patches/sky_sectors.h"

namespace sunlit::light {
namespace {

/// Of the samples' usual distance, 3 m, or less in small worlds: as high as lamps hang above what they light.
constexpr float kLampHeights = 12.0f;

/// What of a bake is done by the clock, about: once rays can be cast, kinds of triangles are known, and
/// samples and leaves are found.
constexpr double kRaysMade = 0.01, kBegun = 0.04, kSampled = 0.4;

/// What the bake has to look for: `pieces` that shine by themselves, what these and compact sources light
/// brightly, and what all lamps do.
AreaLights brightIn(const BakeScene& scene, const ShiningLights& shining,
                    std::vector<AreaLights::Piece> pieces) {
  const std::vector<scene::Lamp>& lamps = scene.geometry.scene->lamps;
  std::vector<LampBeam> beams = shining.beams;
  for (const LampSet& set : lampSets(lamps))
    for (const scene::Lamp& lamp : lampsOf(set, lamps)) beams.emplace_back(lamp);
  for (const std::vector<AreaLights::Piece>& lit : {litPieces(scene, beams), litPieces(scene, shining.baked)})
    pieces.insert(pieces.end(), lit.begin(), lit.end());
  return AreaLights(scene.rays, std::move(pieces));
}

/// Null: there are none.
std::shared_ptr<const std::vector<CompactSource>> sourcesOf(const TransportData& data) {
  std::vector<CompactSource> sources;
  for (const KeptSource& one : data.compact_sources) sources.push_back(sourceOf(one));
  if (sources.empty()) return nullptr;
  return std::make_shared<const std::vector<CompactSource>>(std::move(sources));
}

}  // namespace

void validate(const TransportOptions& options) {
  requireFields(options);
}

double finestOf(const TransportOptions& options, const Geometry& geometry) {
  constexpr double kUsual_m = 0.25, kLeast_m = 0.02, kOfDiagonal = 1.0 / 64.0;
  if (options.finest_m) return *options.finest_m;
  Eigen::AlignedBox3f box;
  for (const scene::Chunk& chunk : geometry.chunks) box.extend(chunk.box);
  if (box.isEmpty()) return kUsual_m;
  return std::clamp(kOfDiagonal * static_cast<double>(box.diagonal().norm()), kLeast_m, kUsual_m);
}

std::shared_ptr<const Transport> Transport::bake(std::shared_ptr<const Geometry> geometry,
                                                 const TransportOptions& options,
                                                 const BakeProgress& progress) {
  validate(options);
  const auto start = std::chrono::steady_clock::now();
  const Progress report = [&](double share) {
    constexpr double kTells = 0.05;  // of the whole: before that, nobody knows how long the rest will take
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    if (progress) progress(share, share < kTells ? std::nan("") : taken.count() * (1.0 - share) / share);
  };
  report(0.0);
  const BakeRays rays(geometry);
  const std::vector<TriangleTraits> traits =
      triangleTraits(*geometry, rays, partOf(report, kRaysMade, kBegun));
  const RefineLimits limits{static_cast<float>(finestOf(options, *geometry)),
                            static_cast<std::size_t>(options.samples)};
  const BakeScene scene{*geometry, rays, traits};
  const ShiningParts parts = partedBySize(shiningPieces(*geometry, traits),
                                          kLampHeights * static_cast<float>(finestOf({}, *geometry)));
  const AreaLights baked(rays, parts.others), compact(rays, parts.of_compact);
  const std::vector<LampBeam> beams(parts.compact.begin(), parts.compact.end());
  const ShiningLights shining{baked, compact, beams};
  const bool any_leaves = std::any_of(traits.begin(), traits.end(),
                                      [](const TriangleTraits& triangle) { return isLeaf(triangle.kind); });
  const double leaf_share = any_leaves ? 0.2 : 0.0;
  auto data = std::make_unique<TransportData>();
  SceneSamples samples;
  std::mutex mutex;
  double leaves = 0.0, sampled = 0.0;
  const auto note = [&](double share, double* part) {
    const std::lock_guard<std::mutex> lock(mutex);
    *part = share;
    report(kBegun + leaf_share * leaves + (kSampled - kBegun - leaf_share) * sampled);
  };
  // Side by side, since some of the sampling is work for one thread.
  tbb::parallel_invoke(
      [&] { data->leaves = leafOpenness(geometry, traits, [&](double share) { note(share, &leaves); }); },
      [&] {
        samples = sampleScene(scene, brightIn(scene, shining, parts.others), limits,
                              [&](double share) { note(share, &sampled); });
      });
  const GatherOptions gather{options.rays_per_patch, options.bounces, shining, partOf(report, kSampled, 1.0)};
  const UselessSamples useless = gatherLight(scene, samples, gather, data.get());
  samples.mesh.drop(useless.are, useless.in_place);
  data->mesh = std::move(samples.mesh);
  for (const CompactSource& source : parts.compact) data->compact_sources.push_back(kept(source));
  return std::make_shared<const Transport>(options, std::move(data));
}

Transport::Transport(const TransportOptions& options, std::unique_ptr<const TransportData> data)
    : options_(options),
      data_(std::move(data)),
      node_open_(std::make_shared<const std::vector<float>>(openSky(*data_))),
      glint_nodes_(light::glintNodes(*data_)),
      compact_sources_(sourcesOf(*data_)) {
  data_->letGo();
}
Transport::~Transport() = default;

std::vector<NodeLight> Transport::relight(const sky::Daylight& day, const std::vector<float>& lamp_shares,
                                          const Visibility* visibility) const {
  const FindLight find = light::relight(data_, {day, lamp_shares, visibility});
  std::vector<NodeLight> light(nodeCount());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, light.size(), 1024),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      find(range.begin(), range.end(), &light[range.begin()]);
                    });
  return light;
}

Illumination Transport::illumination(const sky::Daylight& day, const std::vector<float>& lamp_shares,
                                     const Visibility* visibility) const {
  Illumination light(day);
  light.nodes =
      std::make_shared<const NodeLights>(nodeCount(), light::relight(data_, {day, lamp_shares, visibility}));
  light.node_open = node_open_;
  light.compact_sources = compact_sources_;
  if (visibility) light.glint_nodes = glint_nodes_;
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
