// What one pose of three 640x480 images costs, part by part: detectors per image, matching per pair (beside
// cv::BFMatcher), differences of pixels (beside memcpy of the same bytes), and the whole. Reads the Leuven
// photographs where they are there, and makes images where they are not.
#include <benchmark/benchmark.h>

#include <cstring>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "sunlit/evaluate/differences/comparer.h"

namespace {

using namespace sunlit::evaluate;

cv::Mat madeImage(int number) {
  cv::Mat image(480, 640, CV_8UC3);
  cv::RNG generator(7);  // the same content for all, under another light
  generator.fill(image, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(image, image, {}, 2.0);
  image.convertTo(image, -1, 6.0 / number, -300.0 / number);
  return image;
}

const std::vector<cv::Mat>& images() {
  static const std::vector<cv::Mat> all = [] {
    std::vector<cv::Mat> loaded;
    for (const int number : {1, 2, 6}) {
      const std::string path =
          std::string(SUNLIT_SHARED_DIR) + "/data/leuven/img" + std::to_string(number) + ".ppm";
      cv::Mat image = std::filesystem::exists(path) ? cv::imread(path) : madeImage(number);
      cv::resize(image, image, {640, 480}, 0, 0, cv::INTER_AREA);
      cv::cvtColor(image, image, cv::COLOR_BGR2RGB);
      loaded.push_back(image);
    }
    return loaded;
  }();
  return all;
}

void detector(benchmark::State& state, const std::string& type) {
  const cv::Mat grey = makePicture(images()[0]).grey;
  const cv::Ptr<cv::Feature2D> kept = makeDetector(type)->make();
  std::vector<cv::KeyPoint> key_points;
  cv::Mat descriptors;
  for (auto _ : state) kept->detectAndCompute(grey, cv::noArray(), key_points, descriptors);
  state.counters["key_points"] = static_cast<double>(key_points.size());
}

void matching(benchmark::State& state, const std::string& type, bool is_ours) {
  const std::unique_ptr<Detector> detector = makeDetector(type);
  const Features a = detectFeatures(*detector, makePicture(images()[0]));
  const Features b = detectFeatures(*detector, makePicture(images()[1]));
  const int norm = detector->norm();
  for (auto _ : state) {
    if (is_ours) {
      benchmark::DoNotOptimize(twoNearestBothWays(a.descriptors, b.descriptors, norm));
    } else {
      std::vector<std::vector<cv::DMatch>> matches;
      cv::BFMatcher(norm).knnMatch(a.descriptors, b.descriptors, matches, 2);
      benchmark::DoNotOptimize(matches);
    }
  }
}

void direct(benchmark::State& state) {
  const Picture a = makePicture(images()[0]);
  const Picture b = makePicture(images()[1]);
  const Differences known;
  const Features none;
  for (auto _ : state) {
    for (const char* name : {"boolean_rgb", "boolean_grey", "euclidean_rgb", "euclidean_grey"})
      benchmark::DoNotOptimize(known.at(name).between({a, none}, {b, none}, {BothWays{}, {}}, {}));
  }
  state.SetBytesProcessed(state.iterations() * 2 * 4 * static_cast<std::int64_t>(a.rgb.total()));
}

void copying(benchmark::State& state) {
  const std::size_t bytes = 4 * images()[0].total();
  std::vector<char> from(bytes, 1);
  std::vector<char> to(bytes);
  for (auto _ : state) {
    std::memcpy(to.data(), from.data(), bytes);
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(state.iterations() * 2 * static_cast<std::int64_t>(bytes));
}

void wholePose(benchmark::State& state) {
  const Comparer comparer({});
  for (auto _ : state) benchmark::DoNotOptimize(comparer.compare(images(), {{0, 1}, {0, 2}, {1, 2}}));
}

}  // namespace

int main(int argc, char** argv) {
  for (const std::string& name : readyDetectorTypes()) {
    const auto add = [](const std::string& label, auto body) {
      benchmark::RegisterBenchmark(label.c_str(), body)
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime()
          ->MeasureProcessCPUTime();
    };
    add("detect/" + name, [name](benchmark::State& state) { detector(state, name); });
    add("match/" + name, [name](benchmark::State& state) { matching(state, name, true); });
    add("match_opencv/" + name, [name](benchmark::State& state) { matching(state, name, false); });
  }
  benchmark::RegisterBenchmark("direct_differences", direct)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("memcpy_of_as_many_bytes", copying)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("whole_pose_of_three", wholePose)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->MeasureProcessCPUTime();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
