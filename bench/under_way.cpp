// What a picture costs while the camera moves, beside the same picture of one that stands: at 10 m/s along
// the built-in path, 640 × 480, four samples a pixel, the light of one condition. Each pose is taken by both
// in turn, so that the `ratio` printed at the end of each is of one run. The pose that both share, drawn
// before, is not in it. The bake is taken from the usual cache, or made there first.
#include <benchmark/benchmark.h>

#include "drive.h"
#include "race_track.h"
#include "sunlit/path/path.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/render/renderer.h"

namespace {

using namespace sunlit;

constexpr int kPoses = 12;
constexpr double kRate_hz = 10.0;

void picture(benchmark::State& state) {
  render::RenderOptions options;
  options.camera = image::PinholeCamera::fromFieldOfView(640, 480, Angle::degrees(60.0));
  render::Renderer renderer(bench::bakedRaceTrack(), options);
  const light::Illumination light = bench::bakedRaceTrack().transport->illumination(bench::daylightAt(50.0));
  const std::vector<Eigen::Isometry3d> poses = path::posesAlong(scene::raceTrackWaypoints(), {});
  render::UnderWay way;
  way.line_delay_s = 1e-6 * static_cast<double>(state.range(0));
  way.exposure_s = 1e-3 * static_cast<double>(state.range(1));
  double moving_s = 0.0, standing_s = 0.0, exposures = 0.0;
  int number = 0;
  for (auto _ : state) {
    const int index = number++ % kPoses * static_cast<int>(poses.size()) / kPoses;
    renderer.look(poses[static_cast<std::size_t>(index)] * linkFromOptical());
    way.motion = path::motionAt(poses, index, {kRate_hz});
    exposures += renderer.exposures(way);
    const double seconds = bench::secondsOf([&] { benchmark::DoNotOptimize(renderer.light(light, 0, way)); });
    state.SetIterationTime(seconds);
    moving_s += seconds;
    standing_s += bench::secondsOf([&] { benchmark::DoNotOptimize(renderer.light(light)); });
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
