// What mirrors cost a picture: a yard with a floor that fills half of it, 640×480 with four samples a pixel,
// drawn and lit. Argument: whether the floor is polished; the lines of one run are to be compared.
#include <benchmark/benchmark.h>

#include <memory>
#include <utility>

#include "drive.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/render/renderer.h"
#include "support/patches.h"

namespace {

using namespace sunlit;

scene::Scene yard(bool polished) {
  scene::Scene scene;
  scene::Material material;
  material.roughness = polished ? 0.05f : 0.6f;
  scene.materials.push_back(material);
  material.roughness = 0.9f;
  scene.materials.push_back(material);
  test::addGround(&scene, 0, 100.0f);
  for (int i = 0; i < 12; ++i) {
    const auto x = static_cast<float>(8 + 4 * i);
    const auto y = static_cast<float>((i % 5) * 5 - 10);
    test::addBlock(&scene, 1, {x, y, 0.0f}, {2.0f, 2.0f, 6.0f});
  }
  return scene;
}

void picture(benchmark::State& state) {
  render::RenderOptions options;
  options.camera = image::PinholeCamera::fromFieldOfView(640, 480, Angle::degrees(60.0));
  render::Renderer renderer(std::make_shared<const scene::Scene>(yard(state.range(0) != 0)), options);
  const light::Illumination light(bench::daylightAt(40.0));
  Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();
  map_from_camera.translation().z() = 1.6;
  const Eigen::Isometry3d pose = map_from_camera * linkFromOptical();
  for (auto _ : state) {
    renderer.look(pose);
    benchmark::DoNotOptimize(renderer.light(light));
  }
}

BENCHMARK(picture)
    ->ArgName("polished")
    ->Arg(0)
    ->Arg(1)
    ->Iterations(10)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();
