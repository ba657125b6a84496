// What baked light costs: the bake itself, another sky, and finding the light of what a camera sees; beside
// it the ray rate that bounds the first and the memory traffic that bounds the second. Argument: world (0 the
// built-in one, 1 a real circuit and 2 a Gazebo world from the shared input if present).
#include <benchmark/benchmark.h>

#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "light/bake/gather/relight.h"
#include "light/bake/samples/bake_rays.h"
#include "light/bake/samples/probe.h"
#include "light/bake/samples/transport_data.h"
#include "light/picture/ready_picture.h"
#include "sunlit/image/cache_folder.h"
#include "sunlit/light/transport.h"
#include "sunlit/light/world.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/render/renderer.h"
#include "sunlit/scene/load.h"
#include "sunlit/scene/race_track.h"
#include "sunlit/sky/atmosphere.h"

namespace {

using namespace sunlit;

const std::string kWorlds = std::string(SUNLIT_SHARED_DIR) + "/worlds/";

struct Stage {
  light::World world;
  std::shared_ptr<const light::Transport> transport;

  explicit Stage(const std::string& name)
      : world(std::make_shared<const scene::Scene>(
            scene::load(name, scene::SearchPath{{kWorlds + "aws_racetrack/models"}}))) {}
};

Stage* stage(benchmark::State& state) {
  static std::unique_ptr<Stage> stages[3];
  const auto which = static_cast<std::size_t>(state.range(0));
  const std::string names[] = {scene::kRaceTrack, kWorlds + "forza/forza.glb",
                               kWorlds + "aws_racetrack/worlds/racetrack_day.world"};
  if (which > 0 && !std::ifstream(names[which])) {
    state.SkipWithError("no shared input");
    return nullptr;
  }
  if (!stages[which]) stages[which] = std::make_unique<Stage>(names[which]);
  return stages[which].get();
}

/// With the bake of the usual cache, or made there first.
Stage* bakedStage(benchmark::State& state) {
  Stage* s = stage(state);
  if (s && !s->transport)
    s->transport = light::Transport::cached(s->world.geometry, {}, image::usualCacheFolder());
  return s;
}

sky::Daylight morning() {
  static const sky::Atmosphere atmosphere{sky::AtmosphereOptions()};
  return atmosphere.daylight({Direction(Azimuth::degrees(120.0), Angle::degrees(20.0)), 1.0});
}

void bake(benchmark::State& state) {
  Stage* s = stage(state);
  if (!s) return;
  for (auto _ : state) s->transport = light::Transport::bake(s->world.geometry, {});
  state.counters["samples"] = static_cast<double>(s->transport->sampleCount());
  state.counters["nodes"] = static_cast<double>(s->transport->nodeCount());
}

/// Rays as the bake casts them, in packets of 16 neighbours and one direction, on one core, without what is
/// done with their hits.
void rays(benchmark::State& state) {
  Stage* s = stage(state);
  if (!s) return;
  const light::BakeRays scene(s->world.geometry);
  const light::SkyPatches patches(3);
  const light::Geometry& geometry = *s->world.geometry;
  std::size_t cast = 0, next = 0;
  for (auto _ : state) {
    std::array<light::Receiver, light::RayPacket::kSize> receivers;
    for (light::Receiver& receiver : receivers) {
      const std::uint32_t t = static_cast<std::uint32_t>(next++ % geometry.triangles.size());
      receiver.origins.fill(geometry.positions[geometry.triangles[t][0]]);
      receiver.lifts.fill(0.005f * geometry.planes[t].normal);
      receiver.normal = geometry.planes[t].normal;
    }
    next += 997 * light::RayPacket::kSize;
    light::probe(scene, patches.rays(), {receivers.data(), light::RayPacket::kSize},
                 [&](int, std::size_t, float, const light::HitLayers&) { ++cast; });
  }
  state.counters["rays_per_second_on_one_core"] =
      benchmark::Counter(static_cast<double>(cast), benchmark::Counter::kIsRate);
}

void relight(benchmark::State& state) {
  Stage* s = bakedStage(state);
  if (!s) return;
  const sky::Daylight day = morning();
  for (auto _ : state) benchmark::DoNotOptimize(s->transport->relight(day));
  const double bytes = static_cast<double>(s->transport->sampleCount()) * 2.0 * light::SkyPatches::kCount +
                       static_cast<double>(s->transport->nodeCount()) * 40.0;
  state.counters["bytes_per_second"] =
      benchmark::Counter(bytes, benchmark::Counter::kIsIterationInvariantRate);
}

/// What is found at once under another sun: sun and moon by rays in BakedRooms. The light of a node is found
/// when a picture first shows it.
void anotherSun(benchmark::State& state) {
  Stage* s = bakedStage(state);
  if (!s) return;
  const sky::Daylight day = morning();
  for (auto _ : state)
    benchmark::DoNotOptimize(s->transport->illumination(day, {}, s->world.visibility.get()));
}

/// The limit of relight: the same bytes, only added up.
void readMemory(benchmark::State& state) {
  Stage* s = bakedStage(state);
  if (!s) return;
  const std::vector<std::uint64_t> memory(s->transport->sampleCount() * 2 * light::SkyPatches::kCount / 8, 1);
  for (auto _ : state) {
    std::uint64_t sum = 0;
    for (const std::uint64_t word : memory) sum += word;
    benchmark::DoNotOptimize(sum);
  }
  state.counters["bytes_per_second_on_one_core"] = benchmark::Counter(
      static_cast<double>(memory.size() * 8), benchmark::Counter::kIsIterationInvariantRate);
}

void findPlaces(benchmark::State& state) {
  Stage* s = bakedStage(state);
  if (!s) return;
  render::RenderOptions options;
  options.camera = image::PinholeCamera::fromFieldOfView(640, 480, Angle::degrees(60.0));
  light::World world = s->world;
  world.transport = s->transport;
  render::Renderer renderer(world, options);
  Eigen::Isometry3d map_from_link = Eigen::Isometry3d::Identity();
  map_from_link.translation() = scene::raceTrackWaypoints()[0] + Eigen::Vector3d::UnitZ();
  renderer.look(map_from_link * linkFromOptical());
  const light::Surfaces& surfaces = renderer.surfaces();
  light::Outlooks outlooks;
  std::size_t count = 0;
  for (const light::Tile& tile : surfaces.tiles) count += tile.surfaces.size();
  for (auto _ : state) light::findOutlooks(surfaces, {world, *world.visibility}, &outlooks);
  state.counters["surfaces"] = static_cast<double>(count);
}

void worlds(benchmark::internal::Benchmark* line) {
  line->Arg(0)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}
BENCHMARK(bake)->Apply(worlds)->Iterations(1);
BENCHMARK(rays)->Apply(worlds)->Iterations(2000);
BENCHMARK(relight)->Apply(worlds);
BENCHMARK(anotherSun)->Apply(worlds);
BENCHMARK(readMemory)->Apply(worlds);
BENCHMARK(findPlaces)->Arg(0)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
