// What one pose and one condition cost, stage by stage, at 640×480 with four samples a pixel. Poses are
// spread over the path; each iteration takes the next. Arguments: world (0 the built-in one, 1 a real circuit
// from the shared input if present, 2 the built-in one without fractal detail) and, for light, the sun's
// elevation in degrees. Beside the time stands the processor time of all threads.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "render/geometry_pass.h"
#include "render/gl_context.h"
#include "render/resolve.h"
#include "sunlit/image/exposure.h"
#include "sunlit/light/lighting.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/scene/load.h"
#include "sunlit/scene/race_track.h"
#include "sunlit/sky/atmosphere.h"

namespace {

using namespace sunlit;

enum World { kBuiltInWorld = 0, kCircuitWorld = 1, kPlainWorld = 2 };
constexpr std::size_t kPoses = 24;
const std::string kCircuit = std::string(SUNLIT_SHARED_DIR) + "/worlds/forza/forza.glb";

/// A camera 1 m above `points[at]`, level, towards the next.
Eigen::Isometry3d poseAt(const std::vector<Eigen::Vector3d>& points, std::size_t at) {
  const Eigen::Vector3d towards = points[(at + 1) % points.size()] - points[at];
  Eigen::Isometry3d map_from_link = Eigen::Isometry3d::Identity();
  map_from_link.linear() =
      Eigen::AngleAxisd(std::atan2(towards.y(), towards.x()), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  map_from_link.translation() = points[at] + Eigen::Vector3d::UnitZ();
  return map_from_link * linkFromOptical();
}

std::vector<Eigen::Vector3d> circuitPoints() {
  std::ifstream file(std::string(SUNLIT_SHARED_DIR) + "/worlds/forza/waypoints.csv");
  std::vector<Eigen::Vector3d> points;
  for (std::string line; std::getline(file, line);) {
    Eigen::Vector3d p;
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf", &p.x(), &p.y(), &p.z()) == 3) points.push_back(p);
  }
  return points;
}

/// One world with everything that looks at it.
struct Stage {
  explicit Stage(int world) {
    const bool circuit = world == kCircuitWorld;
    scene::Scene loaded = scene::load(circuit ? kCircuit : scene::kRaceTrack, scene::SearchPath{});
    if (world == kPlainWorld) {
      for (scene::Material& material : loaded.materials) material.detail.contrast = 0.0f;
    }
    const auto scene = std::make_shared<const scene::Scene>(std::move(loaded));
    const auto points = circuit ? circuitPoints() : scene::raceTrackWaypoints();
    for (std::size_t i = 0; i < kPoses; ++i) poses.push_back(poseAt(points, i * points.size() / kPoses));
    view.camera = image::PinholeCamera::fromFieldOfView(640, 480, Angle::degrees(60.0));
    view.supersampling = 2;
    geometry = std::make_shared<const light::Geometry>(scene);
    visibility = std::make_unique<light::Visibility>(geometry);
    pass = std::make_unique<render::GeometryPass>(geometry, view, 0.0);
  }
  void look(std::size_t pose) {
    view.map_from_optical = poses[pose % poses.size()];
    pass->draw(view, &samples);
  }
  void resolve() { render::resolveSurfaces({view, *geometry, samples}, &surfaces); }

  std::vector<Eigen::Isometry3d> poses;
  render::View view;
  std::shared_ptr<const light::Geometry> geometry;
  std::unique_ptr<light::Visibility> visibility;
  render::GlContext context;
  std::unique_ptr<render::GeometryPass> pass;
  std::vector<render::PackedSample> samples;
  light::Surfaces surfaces;
};

Stage* stage(benchmark::State& state) {
  static std::unique_ptr<Stage> stages[3];
  const auto world = static_cast<std::size_t>(state.range(0));
  if (world == kCircuitWorld && !std::ifstream(kCircuit)) {
    state.SkipWithError("no shared input");
    return nullptr;
  }
  if (!stages[world]) stages[world] = std::make_unique<Stage>(static_cast<int>(world));
  stages[world]->context.makeCurrent();
  return stages[world].get();
}

sky::Daylight daylightAt(double elevation_deg) {
  static const sky::Atmosphere atmosphere{sky::AtmosphereOptions()};
  return atmosphere.daylight({Direction(Azimuth::degrees(120.0), Angle::degrees(elevation_deg)), 1.0});
}

void drawAndReadBack(benchmark::State& state) {
  Stage* s = stage(state);
  if (!s) return;
  std::size_t pose = 0;
  for (auto _ : state) s->look(pose++);
}

void readBack(benchmark::State& state) {
  Stage* s = stage(state);
  if (!s) return;
  s->look(0);
  for (auto _ : state) {
    glReadPixels(0, 0, 1280, 960, GL_RGBA_INTEGER, GL_UNSIGNED_INT, s->samples.data());
  }
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

void depth(benchmark::State& state) {
  onPoses(state, false, [](Stage& s) {
    benchmark::DoNotOptimize(render::resolveDepth({s.view, *s.geometry, s.samples}, *s.visibility));
  });
}

void light(benchmark::State& state) {
  const sky::Daylight day = daylightAt(static_cast<double>(state.range(1)));
  onPoses(state, true, [&day](Stage& s) {
    benchmark::DoNotOptimize(light::illuminate(s.surfaces, *s.geometry->scene, *s.visibility, day));
  });
}

void rays(benchmark::State& state) {
  const Eigen::Vector3f sun =
      daylightAt(static_cast<double>(state.range(1))).sun().towards.vector().cast<float>();
  std::size_t count = 0;
  onPoses(state, true, [&](Stage& s) {
    std::vector<std::uint8_t> blocked;
    std::vector<float> x, y, z;
    for (const light::Tile& tile : s.surfaces.tiles) {
      const std::size_t n = tile.origin_x.size();
      x.assign(n, sun.x()), y.assign(n, sun.y()), z.assign(n, sun.z()), blocked.resize(n);
      s.visibility->occluded(
          {tile.origin_x.data(), tile.origin_y.data(), tile.origin_z.data(), x.data(), y.data(), z.data(), n},
          blocked.data());
      count += n;
    }
  });
  state.counters["rays_per_second_on_one_core"] =
      benchmark::Counter(static_cast<double>(count), benchmark::Counter::kIsRate);
}

void develop(benchmark::State& state) {
  Stage* s = stage(state);
  if (!s) return;
  s->look(0);
  s->resolve();
  const image::LinearImage image =
      light::illuminate(s->surfaces, *s->geometry->scene, *s->visibility, daylightAt(20.0));
  for (auto _ : state) benchmark::DoNotOptimize(image::develop(image, image::chooseEv100(image, {})));
}

constexpr int kRuns = 24;  // each pose once
BENCHMARK(drawAndReadBack)
    ->Arg(0)
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(kRuns)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(readBack)
    ->Arg(0)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(kRuns)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(resolve)
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(kRuns)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(depth)
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(kRuns)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(light)
    ->ArgsProduct({{0, 1}, {60, 20, 5, -10}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(kRuns)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(rays)
    ->ArgsProduct({{0, 1}, {60, 5}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(kRuns)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(develop)
    ->Arg(0)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(kRuns)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
