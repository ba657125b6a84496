// What a picture costs before a lens, beside one of the same size before a pinhole: pose, depth and the light
// of one condition, in the built-in world, four samples a pixel. Poses are spread over the path, each in turn
// by both, so that the `ratio` printed at the end of each is of one run. The bake is taken from the usual
// cache, or made there first.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "drive.h"
#include "race_track.h"
#include "sunlit/render/renderer.h"
#include "support/published_lenses.h"

namespace {

using namespace sunlit;

constexpr std::size_t kPoses = 24;

/// The rows of publishedLenses() that are measured.
PublishedLens lensOf(const benchmark::State& state) {
  return publishedLenses()[static_cast<std::size_t>(state.range(0))];
}

std::unique_ptr<render::Renderer> rendererOf(const PublishedLens& lens, render::RasterizerKind kind) {
  render::RenderOptions options;
  options.camera = lens.camera;
  options.distortion = lens.distortion;
  options.rasterizer = kind;
  return std::make_unique<render::Renderer>(bench::bakedRaceTrack(), options);
}

/// The same size, and as wide as a pinhole is asked for: 60 degrees as the node has it by default.
PublishedLens pinholeBeside(const PublishedLens& lens) {
  return {"pinhole",
          image::PinholeCamera::fromFieldOfView(lens.camera.width, lens.camera.height, Angle::degrees(60.0)),
          {}};
}

double secondsOf(render::Renderer* renderer, const Eigen::Isometry3d& pose,
                 const light::Illumination& light) {
  const auto begin = std::chrono::steady_clock::now();
  renderer->look(pose);
  benchmark::DoNotOptimize(renderer->depth());
  benchmark::DoNotOptimize(renderer->light(light));
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void picture(benchmark::State& state) {
  const PublishedLens lens = lensOf(state);
  const auto kind = static_cast<render::RasterizerKind>(state.range(1));
  std::unique_ptr<render::Renderer> bent, straight;
  try {
    bent = rendererOf(lens, kind);
    straight = rendererOf(pinholeBeside(lens), kind);
  } catch (const std::runtime_error& error) {
    return state.SkipWithError(error.what());
  }
  const light::Illumination light = bench::bakedRaceTrack().transport->illumination(bench::daylightAt(50.0));
  const auto points = scene::raceTrackWaypoints();
  double of_bent = 0.0, of_straight = 0.0;
  std::size_t number = 0;
  secondsOf(bent.get(), bench::poseAt(points, 0), light);  // buffers
  secondsOf(straight.get(), bench::poseAt(points, 0), light);
  for (auto _ : state) {
    const Eigen::Isometry3d pose = bench::poseAt(points, number++ % kPoses * points.size() / kPoses);
    const double seconds = secondsOf(bent.get(), pose, light);
    state.SetIterationTime(seconds);
    of_bent += seconds;
    of_straight += secondsOf(straight.get(), pose, light);
  }
  state.SetLabel(lens.name + " " + render::nameOf(kind));
  state.counters["pinhole_ms"] = 1e3 * of_straight / static_cast<double>(number);
  state.counters["ratio"] = of_bent / of_straight;
}

void all(benchmark::internal::Benchmark* benchmark) {
  const std::vector<PublishedLens> lenses = publishedLenses();
  for (const auto kind : render::builtRasterizers()) {
    for (std::size_t i = 0; i < lenses.size(); ++i)
      benchmark->Args({static_cast<std::int64_t>(i), static_cast<std::int64_t>(kind)});
  }
}

BENCHMARK(picture)->Apply(all)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(kPoses);

}  // namespace

BENCHMARK_MAIN();
