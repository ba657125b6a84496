// What a picture costs in each weather, beside one under the clear sky of the same hour: the light of one
// condition and its development, in the built-in world, 640×480 with four samples a pixel, baked light, poses
// spread over the path. Both are taken in turn at each pose; `ratio` is the median of theirs, of light and
// development alone, `pose_ratio` the same with the drawing of a pose by itself, which all its conditions
// share.
//
// Water and snow want a bake each. What a picture costs hardly depends on how fine it is, so these lines bake
// the dry world and its state with few samples, `--samples=N` of them, and keep no file of it; the others
// take the usual bake from the usual cache, or make it there first.
#include <benchmark/benchmark.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "drive.h"
#include "race_track.h"
#include "sunlit/image/exposure.h"
#include "sunlit/image/mean_luminance.h"
#include "sunlit/image/rain_streaks.h"
#include "sunlit/image/shutter.h"
#include "sunlit/render/renderer.h"
#include "sunlit/scene/weathering.h"

namespace {

using namespace sunlit;

constexpr std::size_t kPoses = 24;
constexpr double kSunElevation_deg = 50.0;

int samples_of_states = 1000;

double medianOf(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

/// Of this process, MiB, without what was given back.
double resident_MiB() {
  malloc_trim(0);
  std::size_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

void bake(light::World* world) {
  light::TransportOptions options;
  options.samples = samples_of_states;
  options.rays_per_patch = options.bounces = 1;
  options.finest_m = 2.0;
  world->transport = light::Transport::bake(world->geometry, options);
}

const light::World& dryWorld() {
  static const light::World baked = [] {
    light::World world = bench::raceTrack();
    bake(&world);
    return world;
  }();
  return baked;
}

std::unique_ptr<render::Renderer> rendererOf(const std::vector<light::World>& states) {
  render::RenderOptions options;
  options.camera = image::PinholeCamera::fromFieldOfView(640, 480, Angle::degrees(60.0));
  return std::make_unique<render::Renderer>(states, options);
}

Eigen::Isometry3d poseOf(std::size_t number) {
  static const std::vector<Eigen::Vector3d> points = scene::raceTrackWaypoints();
  return bench::poseAt(points, number % kPoses * points.size() / kPoses);
}

light::Illumination lightOf(const light::World& world, const sky::Weather& weather) {
  return light::illumination(world, bench::daylightAt(kSunElevation_deg, weather));
}

/// As studio::Studio takes one, before what lens and sensor add.
void takePicture(const render::Renderer& renderer, const light::Illumination& light, std::size_t state = 0) {
  image::LinearImage picture = renderer.light(light, state);
  const double ev100 = image::chooseEv100(picture, {});
  const sky::Rain rain = light.day.rain();
  if (rain.mm_per_h > 0.0) {
    const Eigen::Array3f luminance =
        0.5f * (image::meanLuminance(picture).cast<float>() + light.day.groundIlluminance().value / kPiFloat);
    image::RainStreaks streaks;
    streaks.mm_per_h = rain.mm_per_h;
    streaks.seed = rain.seed;
    streaks.exposure_s = image::exposureTime_s(ev100);
    streaks.luminance = luminance;
    const image::Lens lens(renderer.options().camera, {});
    Eigen::Isometry3d map_from_optical = Eigen::Isometry3d::Identity();
    map_from_optical.linear() = renderer.surfaces().map_from_optical;
    map_from_optical.translation() = renderer.surfaces().eye.cast<double>();
    image::addRain(streaks, {lens, map_from_optical, Motion(), renderer.depth()}, &picture);
  }
  benchmark::DoNotOptimize(image::develop(picture, ev100));
}

/// What is measured, and what it stands beside.
struct Pair {
  std::function<void()> changed, clear;
};

/// Seconds of pictures, pose by pose.
class Times {
 public:
  /// Takes turns at being first, so that neither always finds what the other has left in the processor's
  /// caches. Returns what the changed one took.
  double add(double drawing, const Pair& pair) {
    const bool swapped = changed_.size() % 2 != 0;
    const double first = bench::secondsOf(swapped ? pair.clear : pair.changed);
    const double second = bench::secondsOf(swapped ? pair.changed : pair.clear);
    drawing_.push_back(drawing);
    changed_.push_back(swapped ? second : first);
    clear_.push_back(swapped ? first : second);
    return changed_.back();
  }
  void tell(benchmark::State* state) const {
    std::vector<double> ratios, of_poses;
    for (std::size_t i = 0; i < changed_.size(); ++i) {
      ratios.push_back(changed_[i] / clear_[i]);
      of_poses.push_back((drawing_[i] + changed_[i]) / (drawing_[i] + clear_[i]));
    }
    state->counters["ratio"] = medianOf(ratios);
    state->counters["pose_ratio"] = medianOf(of_poses);
    state->counters["clear_ms"] = 1e3 * medianOf(clear_);
    state->counters["median_ms"] = 1e3 * medianOf(changed_);
  }

 private:
  std::vector<double> drawing_, changed_, clear_;
};

/// The sky is made beforehand, as of an hour whose weather stands still.
void standing(benchmark::State& state, const sky::Weather& weather) {
  const auto renderer = rendererOf({bench::bakedRaceTrack()});
  const light::Illumination clear = lightOf(bench::bakedRaceTrack(), {});
  const light::Illumination changed = lightOf(bench::bakedRaceTrack(), weather);
  renderer->look(poseOf(0));  // buffers
  takePicture(*renderer, clear);
  Times times;
  std::size_t number = 0;
  for (auto _ : state) {
    const double drawing = bench::secondsOf([&] { renderer->look(poseOf(number++)); });
    state.SetIterationTime(times.add(
        drawing, {[&] { takePicture(*renderer, changed); }, [&] { takePicture(*renderer, clear); }}));
  }
  times.tell(&state);
}

/// A sky, and its light at all nodes, for each picture.
void moving(benchmark::State& state, sky::Weather weather) {
  const auto renderer = rendererOf({bench::bakedRaceTrack()});
  renderer->look(poseOf(0));  // buffers
  takePicture(*renderer, lightOf(bench::bakedRaceTrack(), weather));
  Times times;
  std::vector<double> skies, relights;
  std::size_t number = 0;
  for (auto _ : state) {
    const double drawing = bench::secondsOf([&] { renderer->look(poseOf(number++)); });
    weather.clock_s = 0.1 * static_cast<double>(number);
    const auto anew = [&](const sky::Weather& now) {
      takePicture(*renderer, lightOf(bench::bakedRaceTrack(), now));
    };
    state.SetIterationTime(times.add(drawing, {[&] { anew(weather); }, [&] { anew({}); }}));
    skies.push_back(
        bench::secondsOf([&] { benchmark::DoNotOptimize(bench::daylightAt(kSunElevation_deg, weather)); }));
    const sky::Daylight day = bench::daylightAt(kSunElevation_deg, weather);
    relights.push_back(bench::secondsOf(
        [&] { benchmark::DoNotOptimize(light::illumination(bench::bakedRaceTrack(), day)); }));
  }
  times.tell(&state);
  state.counters["sky_ms"] = 1e3 * medianOf(skies);
  state.counters["relight_ms"] = 1e3 * medianOf(relights);
}

/// A state of the surfaces beside the dry ones, and what it costs to have it too.
void further(benchmark::State& state, const scene::SurfaceState& surfaces) {
  std::array<double, 5> resident{};
  const light::World& dry = dryWorld();
  const auto of_dry = rendererOf({dry});
  const auto drawn = [](render::Renderer* renderer) {
    return bench::secondsOf([&] { renderer->look(poseOf(0)); }) +
           bench::secondsOf([&] { renderer->look(poseOf(1)); });
  };
  drawn(of_dry.get());
  resident[0] = resident_MiB();
  light::World changed = dry;
  state.counters["weathered_s"] = bench::secondsOf([&] { changed = light::weathered(dry, surfaces); });
  resident[1] = resident_MiB();
  bake(&changed);
  resident[2] = resident_MiB();
  const auto of_dry_again = rendererOf({dry});
  drawn(of_dry_again.get());
  resident[3] = resident_MiB();
  const auto of_both = rendererOf({dry, changed});
  drawn(of_both.get());
  resident[4] = resident_MiB();
  state.counters["weathered_MiB"] = resident[1] - resident[0];
  state.counters["samples"] = static_cast<double>(changed.transport->sampleCount());
  state.counters["bake_MiB"] = resident[2] - resident[1];
  state.counters["renderer_MiB"] = (resident[4] - resident[3]) - (resident[3] - resident[2]);

  const light::Illumination of_clear = lightOf(dry, {}), of_changed = lightOf(changed, {});
  takePicture(*of_both, of_clear, 0);
  Times times;
  std::vector<double> more;
  std::size_t number = 0;
  for (auto _ : state) {
    const Eigen::Isometry3d pose = poseOf(number++);
    const double alone = bench::secondsOf([&] { of_dry->look(pose); });
    more.push_back(bench::secondsOf([&] { of_both->look(pose); }) - alone);
    state.SetIterationTime(times.add(
        alone, {[&] { takePicture(*of_both, of_changed, 1); }, [&] { takePicture(*of_both, of_clear, 0); }}));
  }
  times.tell(&state);
  state.counters["look_more_ms"] = 1e3 * medianOf(more);
}

sky::Weather covered(double oktas, sky::Overcast overcast = sky::Overcast::kLayer) {
  sky::Weather weather;
  weather.cover_oktas = oktas;
  weather.overcast = overcast;
  return weather;
}

sky::Weather windy() {
  sky::Weather weather = covered(4.0);
  weather.wind_m_per_s = 10.0;
  return weather;
}

sky::Weather foggy() {
  sky::Weather weather;
  weather.visibility_m = 150.0;
  return weather;
}

sky::Weather rainy() {
  sky::Weather weather;
  weather.rain_mm_per_h = 10.0;
  return weather;
}

void usual(benchmark::internal::Benchmark* benchmark) {
  benchmark->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(kPoses);
}

BENCHMARK_CAPTURE(standing, clear, sky::Weather())->Apply(usual);  // how far ratios are from 1 by chance
BENCHMARK_CAPTURE(standing, overcast_cie, covered(8.0, sky::Overcast::kCie))->Apply(usual);
BENCHMARK_CAPTURE(standing, overcast_layer, covered(8.0))->Apply(usual);
BENCHMARK_CAPTURE(standing, broken, covered(4.0))->Apply(usual);
BENCHMARK_CAPTURE(moving, broken, windy())->Apply(usual);
BENCHMARK_CAPTURE(standing, fog, foggy())->Apply(usual);
BENCHMARK_CAPTURE(standing, rain, rainy())->Apply(usual);
BENCHMARK_CAPTURE(further, wet, scene::SurfaceState{1.0, 0.0, 0.0})->Apply(usual);
BENCHMARK_CAPTURE(further, puddles, scene::SurfaceState{0.0, 0.2, 0.0})->Apply(usual);
BENCHMARK_CAPTURE(further, snow, scene::SurfaceState{0.0, 0.0, 0.1})->Apply(usual);

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  constexpr const char* kSamples = "--samples=";
  for (int i = 1; i < argc; ++i) {
    if (std::strncmp(argv[i], kSamples, std::strlen(kSamples)) != 0)
      return benchmark::ReportUnrecognizedArguments(argc, argv);
    samples_of_states = std::atoi(argv[i] + std::strlen(kSamples));
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
