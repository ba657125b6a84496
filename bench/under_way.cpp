// What a picture costs while the camera moves, beside the same picture of one that stands: at 10 m/s along
// the built-in path, 640 × 480, four samples a pixel, the light of one condition. Each pose is taken by both
// in turn, so that the `ratio` printed at the end of each is of one run. The pose that both share, drawn
// before, is not in it. The bake is taken from the usual cache, or made there first.
#include <benchmark/benchmark.h>

#include <chrono>
#include <memory>

#include "drive.h"
#include "sunlit/image/cache_folder.h"
#include "sunlit/light/transport.h"
#include "sunlit/path/path.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/render/renderer.h"
#include "sunlit/scene/load.h"
#include "sunlit/scene/race_track.h"

namespace {

using namespace sunlit;

constexpr int kPoses = 12;
constexpr double kRate_hz = 10.0;

const light::World& world() {
  static const light::World baked = [] {
    light::World made(
        std::make_shared<const scene::Scene>(scene::load(scene::kRaceTrack, scene::SearchPath{})));
    made.transport = light::Transport::cached(made.geometry, {}, image::usualCacheFolder());
    return made;
  }();
  return baked;
}

template <typename Work>
double secondsOf(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  benchmark::DoNotOptimize(work());
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void picture(benchmark::State& state) {
  render::RenderOptions options;
  options.camera = image::PinholeCamera::fromFieldOfView(640, 480, Angle::degrees(60.0));
  render::Renderer renderer(world(), options);
  const light::Illumination light = world().transport->illumination(bench::daylightAt(50.0));
  const std::vector<Eigen::Isometry3d> poses = path::posesAlong(scene::raceTrackWaypoints(), {});
  render::UnderWay way;
  way.line_delay_s = 1e-6 * static_cast<double>(state.range(0));
  way.exposure_s = 1e-3 * static_cast<double>(state.range(1));
  double moving_s = 0.0, standing_s = 0.0, exposures = 0.0;
  int number = 0;
  for (auto _ : state) {
    const int index = number++ % kPoses * static_cast<int>(poses.size()) / kPoses;
    renderer.look(poses[static_cast<std::size_t>(index)] * linkFromOptical());
    way.motion = path::motionAt(poses, index, kRate_hz);
    exposures += renderer.exposures(way);
    const double seconds = secondsOf([&] { return renderer.light(light, 0, way); });
    state.SetIterationTime(seconds);
    moving_s += seconds;
    standing_s += secondsOf([&] { return renderer.light(light); });
  }
  state.counters["standing_ms"] = 1e3 * standing_s / number;
  state.counters["exposures"] = exposures / number;
  state.counters["ratio"] = moving_s / standing_s;
}

// us from row to row, ms of exposure.
BENCHMARK(picture)
    ->ArgNames({"line_delay_us", "exposure_ms"})
    ->Args({30, 0})
    ->Args({60, 0})
    ->Args({0, 2})
    ->Args({0, 10})
    ->Args({30, 10})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(kPoses);

}  // namespace

BENCHMARK_MAIN();
