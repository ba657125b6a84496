// What one pose and one condition cost, stage by stage, at 640×480 with four samples a pixel. Poses are
// spread over the path; each iteration takes the next. Arguments: world (0 the built-in one, 1 a real circuit
// from the shared input if present, 2 the built-in one without fractal detail) and, for light, the sun's
// elevation in degrees. Beside the time stands the processor time of all threads. Where baked light is part
// of it, the bake is taken from the usual cache, or made there first.
#include <benchmark/benchmark.h>
#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "drive.h"
#include "light/picture/ready_picture.h"
#include "render/frustum.h"
#include "render/rasterizer.h"
#include "render/resolve.h"
#include "sunlit/image/cache_folder.h"
#include "sunlit/image/exposure.h"
#include "sunlit/light/picture.h"
#include "sunlit/light/transport.h"
#include "sunlit/scene/load.h"
#include "sunlit/scene/race_track.h"

namespace {

using namespace sunlit;
using bench::circuitPoints, bench::daylightAt, bench::kCircuit, bench::poseAt;

enum World { kBuiltInWorld = 0, kCircuitWorld = 1, kPlainWorld = 2 };
constexpr std::size_t kPoses = 24;

/// One world with everything that looks at it.
struct Stage {
  explicit Stage(int which) : world(sceneOf(which)) {
    const bool circuit = which == kCircuitWorld;
    const auto points = circuit ? circuitPoints() : scene::raceTrackWaypoints();
    for (std::size_t i = 0; i < kPoses; ++i) poses.push_back(poseAt(points, i * points.size() / kPoses));
    view.camera = image::PinholeCamera::fromFieldOfView(640, 480, Angle::degrees(60.0));
    view.supersampling = 2;
    const scene::Scene& scene = *world.geometry->scene;
    pyramids = std::make_unique<render::TexturePyramids>(scene);
    maps = std::make_unique<render::SurfaceMaps>(scene,
                                                 static_cast<float>(light::finestOf({}, *world.geometry)));
    rasterizer = make(render::defaultRasterizer());
  }
  static std::shared_ptr<const scene::Scene> sceneOf(int which) {
    const bool circuit = which == kCircuitWorld;
    scene::Scene loaded = scene::load(circuit ? kCircuit : scene::kRaceTrack, scene::SearchPath{});
    if (which == kPlainWorld) {
      for (scene::Material& material : loaded.materials) material.detail.contrast = 0.0f;
    }
    return std::make_shared<const scene::Scene>(std::move(loaded));
  }
  std::unique_ptr<render::Rasterizer> make(render::RasterizerKind kind) const {
    return render::makeRasterizer(kind, {world.geometry, *pyramids, 0.0});
  }
  void look(std::size_t pose, double metres_on = 0.0) {
    view.map_from_optical =
        poses[pose % poses.size()] * Eigen::Translation3d(metres_on * Eigen::Vector3d::UnitZ());
    rasterizer->draw(view, nullptr, &samples);
  }
  render::Seen seen() const {
    return {view, *world.geometry, nullptr, *pyramids, *maps, 0.0f, samples, nullptr};
  }
  void resolve() { render::resolveSurfaces(seen(), &surfaces); }
  const light::World& baked() {
    if (!world.transport)
      world.transport = light::Transport::cached(world.geometry, {}, image::usualCacheFolder());
    return world;
  }
  light::PicturePreparer preparerWithoutBake() const {
    light::World bare = world;
    bare.transport = nullptr;
    return light::PicturePreparer(bare);
  }
  /// What is seen, in the memory of what was prepared before.
  void prepare(light::PicturePreparer* preparer) {
    surfaces = picture.takeSurfaces();
    resolve();
    preparer->prepare({std::move(surfaces), world.visibility, {}}, &picture);
  }
  void findOutlooks(light::FinalGather* gather = nullptr) {
    light::findOutlooks(surfaces, {baked(), *world.visibility, nullptr, gather}, &outlooks);
  }

  light::World world;  ///< see baked()
  std::vector<Eigen::Isometry3d> poses;
  render::View view;
  std::unique_ptr<render::TexturePyramids> pyramids;
  std::unique_ptr<render::SurfaceMaps> maps;
  std::unique_ptr<render::Rasterizer> rasterizer;
  std::vector<render::Sample> samples;
  light::Surfaces surfaces;
  light::Outlooks outlooks;
  light::PreparedPicture picture;
};

Stage* stage(benchmark::State& state) {
  static std::unique_ptr<Stage> stages[3];
  const auto world = static_cast<std::size_t>(state.range(0));
  if (world == kCircuitWorld && !std::ifstream(kCircuit)) {
    state.SkipWithError("no shared input");
    return nullptr;
  }
  if (!stages[world]) stages[world] = std::make_unique<Stage>(static_cast<int>(world));
  return stages[world].get();
}

/// The share of samples that see another triangle than `rasterizer`'s, over all poses.
double shareDiffering(Stage* s, render::Rasterizer* rasterizer) {
  const std::unique_ptr<render::Rasterizer> ours = s->make(render::RasterizerKind::kBuiltin);
  std::vector<render::Sample> samples, others;
  std::size_t differing = 0;
  for (const Eigen::Isometry3d& pose : s->poses) {
    s->view.map_from_optical = pose;
    ours->draw(s->view, nullptr, &samples);
    rasterizer->draw(s->view, nullptr, &others);
    for (std::size_t i = 0; i < samples.size(); ++i) differing += samples[i].triangle != others[i].triangle;
  }
  return static_cast<double>(differing) / static_cast<double>(samples.size() * s->poses.size());
}

/// By the rasterizer `state.range(1)`, and how far it agrees with our own.
void draw(benchmark::State& state) {
  Stage* s = stage(state);
  if (!s) return;
  const auto kind = static_cast<render::RasterizerKind>(state.range(1));
  std::unique_ptr<render::Rasterizer> rasterizer;
  try {
    rasterizer = s->make(kind);
  } catch (const std::runtime_error& error) {
    return state.SkipWithError(error.what());
  }
  state.counters["differing"] = shareDiffering(s, rasterizer.get());  // the first picture makes buffers, too
  std::size_t pose = 0, triangles = 0;
  for (auto _ : state) {
    s->view.map_from_optical = s->poses[pose++ % s->poses.size()];
    rasterizer->draw(s->view, nullptr, &s->samples);
  }
  for (std::size_t i = 0; i < pose; ++i) {
    s->view.map_from_optical = s->poses[i % s->poses.size()];
    const render::Frustum frustum(s->view);
    for (const scene::Chunk& chunk : s->world.geometry->chunks)
      triangles += frustum.touches(chunk.box) ? chunk.count : 0;
  }
  state.SetLabel(render::nameOf(kind) + " " + rasterizer->device());
  state.counters["triangles_in_view"] =
      benchmark::Counter(static_cast<double>(triangles), benchmark::Counter::kAvgIterations);
  state.counters["triangles_per_second"] =
      benchmark::Counter(static_cast<double>(triangles), benchmark::Counter::kIsRate);
  state.counters["samples_per_second"] =
      benchmark::Counter(static_cast<double>(pose * s->samples.size()), benchmark::Counter::kIsRate);
}

/// Writing a picture's samples and nothing else: what memory allows the rasterizer.
void writeSamples(benchmark::State& state) {
  constexpr int kRows = 2 * 480, kColumns = 2 * 640;
  std::vector<render::Sample> samples(static_cast<std::size_t>(kRows * kColumns));
  std::uint32_t number = 0;
  for (auto _ : state) {
    ++number;
    tbb::parallel_for(0, kRows, [&](int row) {
      std::fill_n(samples.begin() + row * kColumns, kColumns, render::Sample{number, 1.0f});
    });
    benchmark::DoNotOptimize(samples.data());
  }
  state.counters["samples_per_second"] =
      benchmark::Counter(static_cast<double>(number) * kRows * kColumns, benchmark::Counter::kIsRate);
}

/// Runs `work` on pose after pose, seen and resolved outside the clock.
template <typename Work>
void onPoses(benchmark::State& state, bool resolve_first, Work work) {
  Stage* s = stage(state);
  if (!s) return;
  std::size_t pose = 0;
  for (auto _ : state) {
    state.PauseTiming();
    s->look(pose++);
    if (resolve_first) s->resolve();
    state.ResumeTiming();
    work(*s);
  }
}

void resolve(benchmark::State& state) {
  onPoses(state, false, [](Stage& s) { s.resolve(); });
}

/// What surfaces have around them, as baked.
void locate(benchmark::State& state) {
  if (Stage* s = stage(state)) {  // the first call reads the bake and makes tables
    s->look(0);
    s->resolve();
    s->findOutlooks();
  }
  onPoses(state, true, [](Stage& s) { s.findOutlooks(); });
}

/// Final gathering with `state.range(1)` rays a patch, at a place that is new, or after some metres that led
/// there, a pose a metre.
void finalGather(benchmark::State& state) {
  Stage* s = stage(state);
  if (!s) return;
  constexpr int kMetres = 6;
  const auto rays = static_cast<int>(state.range(1));
  const bool drives = state.range(2) != 0;
  std::size_t number = 0, nodes = 0, cast = 0, rays_cast = 0;
  for (auto _ : state) {
    state.PauseTiming();
    light::FinalGather gather(s->world.geometry, s->world.visibility, rays);
    for (int metre = drives ? 0 : kMetres; metre <= kMetres; ++metre) {
      s->look(number, metre);
      s->resolve();
      s->findOutlooks(metre < kMetres ? &gather : nullptr);
    }
    number += 4;
    state.ResumeTiming();
    gather.look(s->surfaces, &s->outlooks);
    nodes += gather.nodesSeen();
    cast += gather.nodesCast();
    rays_cast += gather.raysCast();
  }
  const auto mean = benchmark::Counter::kAvgIterations;
  state.counters["nodes"] = benchmark::Counter(static_cast<double>(nodes), mean);
  state.counters["nodes_cast"] = benchmark::Counter(static_cast<double>(cast), mean);
  state.counters["rays_per_second"] =
      benchmark::Counter(static_cast<double>(rays_cast), benchmark::Counter::kIsRate);
}

/// What of them all lights need.
void prepare(benchmark::State& state) {
  onPoses(state, true, [](Stage& s) {
    light::forget(s.surfaces, &s.outlooks);
    benchmark::DoNotOptimize(light::LightTable(s.surfaces, s.outlooks, *s.world.geometry->scene));
  });
}

void depth(benchmark::State& state) {
  onPoses(state, false,
          [](Stage& s) { benchmark::DoNotOptimize(render::resolveDepth(s.seen(), *s.world.visibility)); });
}

/// Of a picture that is prepared, without baked light.
void light(benchmark::State& state) {
  Stage* s = stage(state);
  if (!s) return;
  const sky::Daylight day = daylightAt(static_cast<double>(state.range(1)));
  light::PicturePreparer preparer = s->preparerWithoutBake();
  std::size_t pose = 0;
  for (auto _ : state) {
    state.PauseTiming();
    s->look(pose++);
    s->prepare(&preparer);
    state.ResumeTiming();
    benchmark::DoNotOptimize(s->picture.illuminate(day));
  }
}

/// What a pose costs with its depth and the light, baked light included, of `state.range(1)` conditions, sun
/// high and low in turn.
void pose(benchmark::State& state) {
  Stage* s = stage(state);
  if (!s) return;
  const light::World& world = s->baked();
  const std::array<light::Illumination, 2> lights = {world.transport->illumination(daylightAt(50.0)),
                                                     world.transport->illumination(daylightAt(15.0))};
  light::PicturePreparer preparer(world);
  std::size_t number = 0;
  for (auto _ : state) {
    s->look(number++);
    s->prepare(&preparer);
    benchmark::DoNotOptimize(render::resolveDepth(s->seen(), *world.visibility));
    for (std::int64_t i = 0; i < state.range(1); ++i) {
      benchmark::DoNotOptimize(s->picture.illuminate(lights[(number + static_cast<std::size_t>(i)) % 2]));
    }
  }
  state.counters["images_per_second"] = benchmark::Counter(
      static_cast<double>(number) * static_cast<double>(state.range(1)), benchmark::Counter::kIsRate);
}

/// Rays from every sample to the middle of the sun, or the camera's own: what bounds the light and what could
/// stand in for the rasterizer.
void castRays(benchmark::State& state, bool from_camera) {
  const Eigen::Vector3f sun = daylightAt(from_camera ? 60.0 : static_cast<double>(state.range(1)))
                                  .sun()
                                  .towards.vector()
                                  .cast<float>();
  std::size_t count = 0;
  onPoses(state, true, [&](Stage& s) {
    tbb::combinable<std::size_t> rays([] { return std::size_t{0}; });
    tbb::parallel_for(std::size_t{0}, s.surfaces.tiles.size(), [&](std::size_t i) {
      const light::Tile& tile = s.surfaces.tiles[i];
      const std::size_t n = tile.origin_x.size();
      const Eigen::Vector3f eye = s.surfaces.eye;
      std::vector<float> x(n, sun.x()), y(n, sun.y()), z(n, sun.z());
      std::vector<float> from_x = tile.origin_x, from_y = tile.origin_y, from_z = tile.origin_z;
      if (from_camera) {
        for (std::size_t k = 0; k < n; ++k) {
          x[k] = from_x[k] - eye.x(), y[k] = from_y[k] - eye.y(), z[k] = from_z[k] - eye.z();
          from_x[k] = eye.x(), from_y[k] = eye.y(), from_z[k] = eye.z();
        }
      }
      const light::Rays all{from_x.data(), from_y.data(), from_z.data(), x.data(), y.data(), z.data(), n};
      if (from_camera) {
        std::vector<light::Hit> hits(n);
        s.world.visibility->closest(all, hits.data());
        benchmark::DoNotOptimize(hits.data());
      } else {
        std::vector<std::uint8_t> blocked(n);
        s.world.visibility->occluded(all, blocked.data());
        benchmark::DoNotOptimize(blocked.data());
      }
      rays.local() += n;
    });
    count += rays.combine(std::plus<>());
  });
  state.counters["rays_per_second"] =
      benchmark::Counter(static_cast<double>(count), benchmark::Counter::kIsRate);
}

void sunRays(benchmark::State& state) {
  castRays(state, false);
}
void cameraRays(benchmark::State& state) {
  castRays(state, true);
}

void develop(benchmark::State& state) {
  Stage* s = stage(state);
  if (!s) return;
  s->look(0);
  light::PicturePreparer preparer = s->preparerWithoutBake();
  s->prepare(&preparer);
  const image::LinearImage image = s->picture.illuminate(daylightAt(20.0));
  for (auto _ : state) benchmark::DoNotOptimize(image::develop(image, image::chooseEv100(image, {})));
}

void eachPose(benchmark::internal::Benchmark* line) {
  line->Unit(benchmark::kMillisecond)
      ->Iterations(static_cast<std::int64_t>(kPoses))
      ->MeasureProcessCPUTime()
      ->UseRealTime();
}
BENCHMARK(draw)->ArgsProduct({{0, 1}, {0, 1, 2}})->Apply(eachPose);
BENCHMARK(writeSamples)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(resolve)->Arg(0)->Arg(1)->Arg(2)->Apply(eachPose);
BENCHMARK(locate)->Arg(0)->Apply(eachPose);
BENCHMARK(finalGather)->ArgsProduct({{0}, {1, 2}, {0, 1}})->Apply(eachPose)->Iterations(kPoses / 4);
BENCHMARK(prepare)->Arg(0)->Apply(eachPose);
BENCHMARK(depth)->Arg(0)->Arg(1)->Apply(eachPose);
BENCHMARK(light)->ArgsProduct({{0, 1}, {60, 20, 5, -10}})->Apply(eachPose);
BENCHMARK(pose)->ArgsProduct({{0}, {1, 2, 3}})->Apply(eachPose);
BENCHMARK(sunRays)->ArgsProduct({{0, 1}, {60, 5}})->Apply(eachPose);
BENCHMARK(cameraRays)->Arg(0)->Arg(1)->Apply(eachPose);
BENCHMARK(develop)->Arg(0)->Apply(eachPose);

}  // namespace

BENCHMARK_MAIN();
