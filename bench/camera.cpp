// What lens and sensor add to a picture of 640×480, step by step, beside developing it, which is always paid.
// The light is of a bright picture with the sun in it; no world is needed.
#include <benchmark/benchmark.h>

#include <cmath>

#include "sunlit/image/exposure.h"
#include "sunlit/image/lens_blur.h"
#include "sunlit/image/mosaic.h"
#include "sunlit/image/sensor_noise.h"
#include "sunlit/image/veiling_glare.h"
#include "sunlit/image/vignetting.h"

namespace {

using namespace sunlit;

constexpr double kEv100 = 13.0;

image::Lens lens() {
  return image::Lens(image::PinholeCamera::fromFieldOfView(640, 480, Angle::degrees(60.0)), {});
}

image::LinearImage light() {
  image::LinearImage picture(640, 480);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (int c = 0; c < 3; ++c)
        picture.at(x, y)[c] =
            static_cast<float>(3000.0 + 2000.0 * std::sin(0.1 * x + c) * std::cos(0.07 * y));
  for (int c = 0; c < 3; ++c) picture.at(500, 60)[c] = 1.6e9F;
  return picture;
}

image::Vignetting vignettingOf(bool cos4) {
  image::VignettingOptions options;
  options.cos4 = cos4;
  return image::Vignetting(lens(), options);
}

/// Runs `work` on copies, made outside the clock.
template <typename Picture, typename Work>
void onCopies(benchmark::State& state, const Picture& picture, Work work) {
  for (auto _ : state) {
    state.PauseTiming();
    Picture copy = picture;
    state.ResumeTiming();
    work(&copy);
    benchmark::DoNotOptimize(copy.data.data());
  }
}

void developing(benchmark::State& state) {
  onCopies(state, light(), [](image::LinearImage* picture) {
    benchmark::DoNotOptimize(image::develop(*picture, image::chooseEv100(*picture, {})));
  });
}

void vignetting(benchmark::State& state) {
  const image::Vignetting plain = vignettingOf(true);
  onCopies(state, light(), [&](image::LinearImage* picture) { plain.apply(picture); });
}

void veilingGlare(benchmark::State& state, double wings) {
  image::GlareOptions options;
  options.share = 0.02;
  options.wings = wings;
  const image::VeilingGlare glare(vignettingOf(false), options);
  onCopies(state, light(), [&](image::LinearImage* picture) { glare.apply({}, picture); });
}

void blurring(benchmark::State& state) {
  onCopies(state, light(), [](image::LinearImage* picture) { image::blur({0.5}, picture); });
}

void noise(benchmark::State& state) {
  onCopies(state, light(),
           [](image::LinearImage* picture) { image::addSensorNoise(kEv100, {}, {}, picture); });
}

void mosaic(benchmark::State& state, image::Demosaic way) {
  onCopies(state, image::develop(light(), kEv100), [&](image::Rgb8Image* picture) {
    *picture = image::throughMosaic(std::move(*picture), {image::MosaicPattern::kRggb, way});
  });
}

BENCHMARK(developing)->UseRealTime()->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
BENCHMARK(vignetting)->UseRealTime()->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(veilingGlare, even, 0.0)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(veilingGlare, wings, 0.5)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK(blurring)->UseRealTime()->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
BENCHMARK(noise)->UseRealTime()->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(mosaic, bilinear, image::Demosaic::kBilinear)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(mosaic, vng, image::Demosaic::kVng)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(mosaic, edge_aware, image::Demosaic::kEdgeAware)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();
