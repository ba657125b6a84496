// What one further condition of a pose costs, stage by stage, at 640×480 with four samples a pixel, with
// baked light. Poses are spread over the path; each iteration takes the next. Arguments: world (0 the
// built-in one, 1 a real circuit from the shared input if present) and the sun's elevation in degrees. Beside
// the time stands the processor time of all threads.
#include <benchmark/benchmark.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "drive.h"
#include "light/picture/disc/disc_visibility.h"
#include "light/picture/sky/sky_pixel.h"
#include "light/picture/table/light_table.h"
#include "sunlit/image/cache_folder.h"
#include "sunlit/image/exposure.h"
#include "sunlit/light/transport.h"
#include "sunlit/light/world.h"
#include "sunlit/render/renderer.h"
#include "sunlit/scene/load.h"
#include "sunlit/scene/race_track.h"

namespace {

using namespace sunlit;
using bench::circuitPoints, bench::daylightAt, bench::kCircuit, bench::poseAt;

constexpr std::size_t kPoses = 12;

render::RenderOptions options() {
  render::RenderOptions chosen;
  chosen.camera = image::PinholeCamera::fromFieldOfView(640, 480, Angle::degrees(60.0));
  return chosen;
}

/// One world, baked, and a camera in it.
struct Stage {
  explicit Stage(bool circuit)
      : world(std::make_shared<const scene::Scene>(
            scene::load(circuit ? kCircuit : scene::kRaceTrack, scene::SearchPath{}))) {
    const auto points = circuit ? circuitPoints() : scene::raceTrackWaypoints();
    for (std::size_t i = 0; i < kPoses; ++i) poses.push_back(poseAt(points, i * points.size() / kPoses));
    world.transport = light::Transport::cached(world.geometry, {}, image::usualCacheFolder());
    renderer = std::make_unique<render::Renderer>(world, options());
  }

  void look(std::size_t pose) {
    renderer->look(poses[pose % kPoses]);
    light::Outlooks outlooks;
    light::forget(renderer->surfaces(), &outlooks);
    table = light::LightTable(renderer->surfaces(), outlooks, *world.geometry->scene);
  }

  light::World world;
  std::vector<Eigen::Isometry3d> poses;
  std::unique_ptr<render::Renderer> renderer;
  light::LightTable table;  ///< of what the renderer looks at
};

Stage* stage(benchmark::State& state) {
  static std::unique_ptr<Stage> stages[2];
  const auto which = static_cast<std::size_t>(state.range(0));
  if (which == 1 && !std::ifstream(kCircuit)) {
    state.SkipWithError("no shared input");
    return nullptr;
  }
  if (!stages[which]) stages[which] = std::make_unique<Stage>(which == 1);
  return stages[which].get();
}

/// Runs `work` on pose after pose, seen outside the clock.
template <typename Work>
void onPoses(benchmark::State& state, Work work) {
  Stage* s = stage(state);
  if (!s) return;
  const light::Illumination light =
      light::illumination(s->world, daylightAt(static_cast<double>(state.range(1))));
  std::size_t pose = 0;
  for (auto _ : state) {
    state.PauseTiming();
    s->look(pose++);
    state.ResumeTiming();
    work(*s, light);
  }
}

/// All of it.
void condition(benchmark::State& state) {
  onPoses(state, [](Stage& s, const light::Illumination& light) {
    const image::LinearImage image = s.renderer->light(light);
    benchmark::DoNotOptimize(image::develop(image, image::chooseEv100(image, {})));
  });
  state.counters["images_per_second"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

/// Which part of the sun's disc every surface sees.
void sunShares(benchmark::State& state) {
  std::size_t rays = 0;
  onPoses(state, [&rays](Stage& s, const light::Illumination& light) {
    const light::Surfaces& surfaces = s.renderer->surfaces();
    const light::DiscVisibility sun(
        light::DiscVisibility::straight(light.day.sun(), 0.0f, *s.world.visibility), {surfaces, s.table});
    rays += sun.raysCast();
  });
  state.counters["rays"] = benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kAvgIterations);
}

/// What bounds it: Embree alone, one ray from every sample to the middle of the sun, in the order of the
/// picture, on one core. Rays from foliage and the others apart.
void plainRays(benchmark::State& state, bool leaves) {
  std::size_t count = 0;
  onPoses(state, [&](Stage& s, const light::Illumination& light) {
    const Eigen::Vector3f sun = light.day.sun().towards.vector().cast<float>();
    std::array<std::vector<float>, 6> values;
    std::vector<std::uint8_t> blocked;
    const light::Surfaces& surfaces = s.renderer->surfaces();
    for (std::size_t t = 0; t < surfaces.tiles.size(); ++t) {
      const light::Tile& tile = surfaces.tiles[t];
      for (auto& list : values) list.clear();
      for (const light::LightTable::DiscTarget& target : s.table.tile(t).targets) {
        if (target.leaves != leaves) continue;
        for (std::uint32_t i = target.first_sample; i < target.first_sample + target.samples; ++i) {
          const std::array<float, 6> ray = {tile.origin_x[i], tile.origin_y[i], tile.origin_z[i],
                                            sun.x(),          sun.y(),          sun.z()};
          for (std::size_t k = 0; k < 6; ++k) values[k].push_back(ray[k]);
        }
      }
      blocked.resize(values[0].size());
      s.world.visibility->occluded({values[0].data(), values[1].data(), values[2].data(), values[3].data(),
                                    values[4].data(), values[5].data(), values[0].size()},
                                   blocked.data());
      count += blocked.size();
    }
  });
  state.counters["rays"] = benchmark::Counter(static_cast<double>(count), benchmark::Counter::kAvgIterations);
}
void plainRaysFromFoliage(benchmark::State& state) {
  plainRays(state, true);
}
void plainRaysFromTheRest(benchmark::State& state) {
  plainRays(state, false);
}

/// The sky in every pixel that it is seen in.
void skyPixels(benchmark::State& state) {
  onPoses(state, [](Stage& s, const light::Illumination& light) {
    const light::SkyPixel sky(s.renderer->surfaces(), light.day);
    image::LinearImage image(640, 480);
    for (const light::Tile& tile : s.renderer->surfaces().tiles) sky.addTo(tile, &image);
    benchmark::DoNotOptimize(image.data.data());
  });
}

/// From luminances to the picture.
void develop(benchmark::State& state) {
  Stage* s = stage(state);
  if (!s) return;
  s->renderer->look(s->poses[0]);
  const image::LinearImage image =
      s->renderer->light(light::illumination(s->world, daylightAt(static_cast<double>(state.range(1)))));
  for (auto _ : state) benchmark::DoNotOptimize(image::develop(image, image::chooseEv100(image, {})));
}

void eachPose(benchmark::internal::Benchmark* line) {
  line->ArgsProduct({{0, 1}, {60, 20, 5, -10}})
      ->Unit(benchmark::kMillisecond)
      ->Iterations(static_cast<std::int64_t>(kPoses))
      ->MeasureProcessCPUTime()
      ->UseRealTime();
}
BENCHMARK(condition)->Apply(eachPose);
BENCHMARK(sunShares)->Apply(eachPose);
BENCHMARK(plainRaysFromFoliage)->Apply(eachPose);
BENCHMARK(plainRaysFromTheRest)->Apply(eachPose);
BENCHMARK(skyPixels)->Apply(eachPose);
BENCHMARK(develop)->Apply(eachPose);

}  // namespace

BENCHMARK_MAIN();
