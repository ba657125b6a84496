// SURF on one core: the stages apart and the whole, on a 640 x 480 picture. By default that is a picture made
// here, with detail at every scale and about two thousand key points; SUNLIT_BENCH_IMAGE names a file to take
// instead (it is brought to 640 x 480). The counter `keypoints` says how many there were.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "evaluate/features/surf_descriptor.h"
#include "evaluate/features/surf_maxima.h"
#include "evaluate/features/surf_orientation.h"
#include "sunlit/evaluate/features/surf.h"

namespace {

using namespace sunlit::evaluate;

const cv::Size kSize(640, 480);

// Noise of wavelengths from 2 px to 256 px, each as strong as the square root of its wavelength.
cv::Mat madePicture() {
  cv::RNG random(1);
  cv::Mat sum = cv::Mat::zeros(kSize, CV_32F);
  for (int wavelength = 2; wavelength <= 256; wavelength *= 2) {
    cv::Mat coarse(kSize.height / wavelength + 2, kSize.width / wavelength + 2, CV_32F), fine;
    random.fill(coarse, cv::RNG::NORMAL, 0, 3 * std::sqrt(static_cast<double>(wavelength)));
    cv::resize(coarse, fine, kSize, 0, 0, cv::INTER_CUBIC);
    sum += fine;
  }
  cv::Mat picture;
  cv::Mat(sum + 128).convertTo(picture, CV_8U);
  return picture;
}

cv::Mat picture() {
  const char* file = std::getenv("SUNLIT_BENCH_IMAGE");
  if (file == nullptr) return madePicture();
  cv::Mat image = cv::imread(file, cv::IMREAD_GRAYSCALE);
  if (image.empty()) {
    std::fprintf(stderr, "bench_surf: cannot read %s\n", file);
    std::exit(1);
  }
  cv::resize(image, image, kSize, 0, 0, cv::INTER_AREA);
  return image;
}

struct Fixture {
  cv::Mat grey = picture();
  cv::Mat integral;
  std::vector<std::vector<surf::HessianLayer>> octaves;
  std::vector<cv::KeyPoint> keypoints;
  surf::Orientation orientation;
  surf::Descriptor descriptor{false};

  Fixture() {
    cv::integral(grey, integral, CV_32S);
    makeLayers();
    createSurf()->detect(grey, keypoints);
  }
  void makeLayers() {
    octaves.clear();
    for (int octave = 0; octave < 4; ++octave) {
      const surf::IntegralPlanes planes(integral, 1 << octave);
      octaves.emplace_back();
      for (int layer = 0; layer < 5; ++layer) {
        octaves.back().push_back(surf::hessianLayer(planes, surf::filterSize(octave, layer)));
      }
    }
  }
  std::vector<cv::KeyPoint> maxima() const {
    const surf::MaximaInput input{integral, cv::Mat(), 100};
    std::vector<cv::KeyPoint> all;
    for (int octave = 0; octave < 4; ++octave) {
      const auto& l = octaves[octave];
      for (int k = 1; k < 4; ++k) {
        const auto more = surf::findMaxima({&l[k - 1], &l[k], &l[k + 1], octave}, input);
        all.insert(all.end(), more.begin(), more.end());
      }
    }
    surf::sortByResponse(all);
    return all;
  }
};

Fixture& fixture() {
  static Fixture made;
  return made;
}

void integralStage(benchmark::State& state) {
  cv::Mat integral;
  for (auto _ : state) cv::integral(fixture().grey, integral, CV_32S);
}

void hessianStage(benchmark::State& state) {
  for (auto _ : state) fixture().makeLayers();
}

void maximaStage(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(fixture().maxima());
}

void orientationStage(benchmark::State& state) {
  Fixture& f = fixture();
  for (auto _ : state) {
    for (const auto& point : f.keypoints) benchmark::DoNotOptimize(f.orientation.of(point, f.integral));
  }
}

void patchStage(benchmark::State& state) {
  Fixture& f = fixture();
  for (auto _ : state) {
    const surf::CellImage cells(f.grey);
    surf::PatchCutter cutter(cells);
    for (const auto& point : f.keypoints) benchmark::DoNotOptimize(cutter.turned(point, point.angle));
  }
}

void sumsStage(benchmark::State& state) {
  Fixture& f = fixture();
  const surf::CellImage cells(f.grey);
  surf::PatchCutter cutter(cells);
  const surf::Patch patch = cutter.turned(f.keypoints.front(), 30);
  std::array<float, 64> out{};
  for (auto _ : state) {
    for (std::size_t k = 0; k < f.keypoints.size(); ++k) f.descriptor.of(patch, out.data());
    benchmark::DoNotOptimize(out);
  }
}

void total(benchmark::State& state) {
  const auto surf = createSurf();
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  for (auto _ : state) surf->detectAndCompute(fixture().grey, cv::noArray(), keypoints, descriptors);
  state.counters["keypoints"] = static_cast<double>(keypoints.size());
}

BENCHMARK(integralStage)->Unit(benchmark::kMillisecond);
BENCHMARK(hessianStage)->Unit(benchmark::kMillisecond);
BENCHMARK(maximaStage)->Unit(benchmark::kMillisecond);
BENCHMARK(orientationStage)->Unit(benchmark::kMillisecond);
BENCHMARK(patchStage)->Unit(benchmark::kMillisecond);
BENCHMARK(sumsStage)->Unit(benchmark::kMillisecond);
BENCHMARK(total)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  const tbb::global_control one_core(tbb::global_control::max_allowed_parallelism, 1);
  cv::setNumThreads(1);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
