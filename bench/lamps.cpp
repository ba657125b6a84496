// What lamps cost a picture: the built-in world at night, 640×480 with four samples a pixel, with baked light
// and street lamps along its path, as posts have them: 5 m beside it, 6 m above it. Argument: how many, 0 for
// none; the lines of one run are to be compared. Headlights: a pair that moves with the camera, all else
// dark; 1: with what surfaces pass on of their light.
#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

#include "drive.h"
#include "sunlit/image/cache_folder.h"
#include "sunlit/light/lamps.h"
#include "sunlit/light/transport.h"
#include "sunlit/light/world.h"
#include "sunlit/render/renderer.h"
#include "sunlit/scene/race_track.h"

namespace {

using namespace sunlit;

constexpr std::size_t kPoses = 12;

struct Stage {
  Stage() : world(std::make_shared<const scene::Scene>(scene::raceTrack())) {
    world.transport = light::Transport::cached(world.geometry, {}, image::usualCacheFolder());
    render::RenderOptions options;
    options.camera = image::PinholeCamera::fromFieldOfView(640, 480, Angle::degrees(60.0));
    renderer = std::make_unique<render::Renderer>(world, options);
  }

  light::World world;
  std::vector<Eigen::Vector3d> points = scene::raceTrackWaypoints();
  std::unique_ptr<render::Renderer> renderer;
};

Stage& stage() {
  static Stage only;
  return only;
}

std::vector<scene::Lamp> streetLamps(std::size_t count, bool spots) {
  std::vector<scene::Lamp> lamps;
  const std::vector<Eigen::Vector3d>& points = stage().points;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = i * points.size() / count;
    const Eigen::Vector3d along = (points[(at + 1) % points.size()] - points[at]).normalized();
    scene::Lamp lamp;
    lamp.position =
        (points[at] + 5.0 * Eigen::Vector3d::UnitZ().cross(along) + 6.0 * Eigen::Vector3d::UnitZ())
            .cast<float>();
    lamp.intensity = LinearRgb(800.0f, 700.0f, 500.0f);
    if (spots) {
      lamp.inner_rad = 0.9f;
      lamp.outer_rad = 1.3f;
    }
    lamps.push_back(lamp);
  }
  return lamps;
}

void picture(benchmark::State& state, bool spots) {
  Stage& s = stage();
  light::Illumination light = light::illumination(s.world, bench::daylightAt(-20.0));
  light.lamps = std::make_shared<const std::vector<scene::Lamp>>(
      streetLamps(static_cast<std::size_t>(state.range(0)), spots));
  std::size_t pose = 0;
  for (auto _ : state) {
    s.renderer->look(bench::poseAt(s.points, pose++ % kPoses * s.points.size() / kPoses));
    benchmark::DoNotOptimize(s.renderer->light(light));
  }
}

/// On a body without looks, 0.7 m below the camera.
void headlights(benchmark::State& state) {
  Stage& s = stage();
  static const light::World world = [&] {
    light::World with_body(s.world.geometry->scene, {{}});
    with_body.transport = s.world.transport;
    return with_body;
  }();
  render::Renderer renderer(world, s.renderer->options());
  std::vector<light::BodyLamp> pair(2);
  for (light::BodyLamp& of_body : pair) {
    of_body.body = 0;
    of_body.lamp.direction = Eigen::Vector3f(1.0f, 0.0f, -0.05f).normalized();
    of_body.lamp.inner_rad = 0.175f;
    of_body.lamp.outer_rad = 0.45f;
    of_body.lamp.intensity = LinearRgb(300.0f, 285.0f, 264.0f);
    of_body.lamp.position = {0.5f, 0.1f, -0.7f};
  }
  pair[1].lamp.position.y() = -0.1f;
  light::Illumination light(light::illumination(world, bench::daylightAt(-20.0)));
  std::size_t pose = 0;
  for (auto _ : state) {
    const Eigen::Isometry3d map_from_optical =
        bench::poseAt(s.points, pose++ % kPoses * s.points.size() / kPoses);
    const render::BodyPlaces places = {map_from_optical * linkFromOptical().inverse()};
    std::vector<scene::Lamp> placed;
    for (const light::BodyLamp& of_body : pair) placed.push_back(light::placed(of_body.lamp, places[0]));
    const bool bounced = state.range(0) != 0;
    light.body_lamps = bounced ? std::make_shared<const std::vector<light::BodyLamp>>(pair) : nullptr;
    light.lamps = bounced ? nullptr : std::make_shared<const std::vector<scene::Lamp>>(placed);
    renderer.look(map_from_optical, places);
    benchmark::DoNotOptimize(renderer.light(light));
  }
}

BENCHMARK(headlights)
    ->ArgName("bounced")
    ->Arg(0)
    ->Arg(1)
    ->Iterations(kPoses)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(picture, spots, true)
    ->ArgName("lamps")
    ->Arg(0)
    ->Arg(20)
    ->Arg(200)
    ->Iterations(kPoses)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(picture, points, false)
    ->ArgName("lamps")
    ->Arg(200)
    ->Iterations(kPoses)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();
