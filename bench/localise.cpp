// What finding a picture in a map costs, by detector: key frames made of a view, a query with five true
// neighbours, and one with all of 1,000 key frames looked into. Each beside the detector alone. Reads a
// Leuven photograph where it is there, and makes a picture where it is not.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "sunlit/evaluate/localise/localisation.h"

namespace {

using namespace sunlit;
using namespace sunlit::evaluate;

constexpr int kKeyFrames = 1000;
constexpr int kDifferentViews = 10;

cv::Mat photograph() {
  const std::string path = std::string(SUNLIT_SHARED_DIR) + "/data/leuven/img1.ppm";
  cv::Mat image;
  if (std::filesystem::exists(path)) {
    image = cv::imread(path);
  } else {
    image.create(480, 640, CV_8UC3);
    cv::RNG(7).fill(image, cv::RNG::UNIFORM, 0, 256);
    cv::GaussianBlur(image, image, {}, 2.0);
    image.convertTo(image, -1, 6.0, -300.0);
  }
  cv::resize(image, image, {640, 480}, 0, 0, cv::INTER_AREA);
  return image;
}

/// The photograph as a wall 10 m ahead, seen from `x`; moved on in the picture, so that no two are alike.
PosedView view(double x) {
  static const cv::Mat picture = photograph();
  PosedView made;
  made.camera = image::PinholeCamera::fromFieldOfView(640, 480, Angle::degrees(60.0));
  made.map_from_optical.translation().x() = x;
  made.depth = cv::Mat(480, 640, CV_32FC1, cv::Scalar(10.0));
  const cv::Mat moved = (cv::Mat_<double>(2, 3) << 1, 0, -x * made.camera.fx / 10.0, 0, 1, 0);
  cv::Mat shown;
  cv::warpAffine(picture, shown, moved, picture.size(), cv::INTER_LINEAR, cv::BORDER_REFLECT);
  made.picture = makePicture(shown);
  return made;
}

LocalisationOptions optionsOf(const std::string& detector, Retrieval retrieval) {
  LocalisationOptions options;
  options.detectors = {detector};
  options.localiser.retrieval = retrieval;
  return options;
}

void detection(benchmark::State& state, const std::string& detector) {
  const cv::Mat grey = view(0.0).picture.grey;
  const auto made = makeDetector(detector);
  const cv::Ptr<cv::Feature2D> kept = made->make();
  std::vector<cv::KeyPoint> key_points;
  cv::Mat descriptors;
  for (auto _ : state) kept->detectAndCompute(grey, cv::noArray(), key_points, descriptors);
  state.counters["key_points"] = static_cast<double>(key_points.size());
}

void keyFrame(benchmark::State& state, const std::string& detector) {
  const std::vector<PosedView> views = {view(0.0)};
  Localisation localisation(optionsOf(detector, Retrieval::kTruth));
  for (auto _ : state) localisation.addKeyFrames(views);
  const MapSize size = localisation.mapSizes()[0];
  state.counters["kB"] = static_cast<double>(size.bytes) / 1e3 / static_cast<double>(size.key_frames);
}

/// Some views many times over: what they show does not change what is computed.
const std::vector<PosedView>& mapViews() {
  static const std::vector<PosedView> views = [] {
    std::vector<PosedView> all;
    for (int i = 0; i < kDifferentViews; ++i) all.push_back(view(0.1 * i));
    return all;
  }();
  return views;
}

void query(benchmark::State& state, const std::string& detector, Retrieval retrieval) {
  const auto made = makeDetector(detector);
  LocaliserOptions options;
  options.retrieval = retrieval;
  Localiser localiser(made->space(), options);
  std::vector<KeyFrame> frames;
  for (const PosedView& one : mapViews())
    frames.push_back(keyFrameOf(one, detectFeatures(*made, one.picture)));
  for (int i = 0; i < kKeyFrames; ++i) localiser.add(frames[static_cast<std::size_t>(i % kDifferentViews)]);
  localiser.finish();
  const PosedView asked = view(0.234);
  const Features features = detectFeatures(*made, asked.picture);
  LocalisedQuery found;
  for (auto _ : state) found = localiser.localise({features, asked.camera, asked.map_from_optical});
  state.counters["error_mm"] = 1e3 * found.error_m;
  state.counters["inliers"] = static_cast<double>(found.estimate.inliers.size());
}

void registerAll() {
  for (const std::string detector : {"sift", "orb"}) {
    const auto add = [&](const std::string& name, const auto& run) {
      benchmark::RegisterBenchmark((name + "/" + detector).c_str(), run)
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime()
          ->MeasureProcessCPUTime()
          ->Iterations(name == "query_of_1000_vlad" ? 3 : 5);
    };
    add("detector", [=](benchmark::State& state) { detection(state, detector); });
    add("key_frame", [=](benchmark::State& state) { keyFrame(state, detector); });
    add("query_of_1000_truth", [=](benchmark::State& state) { query(state, detector, Retrieval::kTruth); });
    add("query_of_1000_vlad", [=](benchmark::State& state) { query(state, detector, Retrieval::kVlad); });
    add("query_of_1000_all", [=](benchmark::State& state) { query(state, detector, Retrieval::kAll); });
  }
}

}  // namespace

int main(int argc, char** argv) {
  registerAll();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
