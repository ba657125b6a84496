#include "tools/atlas_estimate.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "sunlit/evaluate/localise/observations.h"
#include "sunlit/quantity/duration.h"

namespace sunlit::tools {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using evaluate::Observation;
using evaluate::ObservationFile;
using evaluate::ObservationKey;

constexpr std::size_t kMostPlaces = 3;
constexpr std::size_t kMostPictures = 4;    // of each
constexpr std::size_t kMostKeyFrames = 5;   // that a query is matched with here
constexpr double kCellRow_bytes = 170.0;    // 17 digits each
constexpr double kCellHead_bytes = 4096.0;  // a block of the disk

double secondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Without a name as soon as it is open, so that nothing stays however the program ends.
std::unique_ptr<ObservationFile> scratchFile() {
  const fs::path path = fs::temp_directory_path() / ("atlas_estimate_" + std::to_string(::getpid()));
  auto file = std::make_unique<ObservationFile>(path.string());
  fs::remove(path);
  return file;
}

/// Evenly spread over all of them.
std::vector<std::size_t> someOf(std::size_t conditions) {
  const std::size_t count = std::min(conditions, kMostPictures);
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < count; ++i) some.push_back(i * conditions / count);
  return some;
}

/// A query is matched with several key frames, so the one pose stands for them all.
void standForSeveral(std::size_t poses, std::int64_t number, ObservationFile* file) {
  const std::vector<ObservationKey> keys = file->keys();
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Observation seen = file->read(i);
    for (std::size_t copy = 1; copy < poses; ++copy) {
      ObservationKey key = keys[i];
      key.pose = number + static_cast<std::int64_t>(copy);
      file->add(key, seen);
    }
  }
}

/// Of the first light's map.
void measureQueries(const AtlasRunOptions& options, const std::vector<std::size_t>& lights,
                    const ObservationFile& file, AtlasCost* cost) {
  const evaluate::DriveIndex index({&file}, [](const evaluate::ObservationKey& key) { return key.pose; });
  evaluate::AtlasOptions atlas = options.atlas;
  atlas.map_every_m = 0.0;
  atlas.localiser.retrieval = evaluate::Retrieval::kTruth;
  for (const std::string& method : atlas.verify.detectors) {
    const evaluate::AtlasMap map(index, atlas, {options.conditions[lights[0]].name, "", method});
    const Clock::time_point begin = Clock::now();
    std::size_t queries = 0;
    for (const std::size_t light : lights) queries += map.find(options.conditions[light].name).size();
    cost->query_s += secondsSince(begin) / static_cast<double>(queries);
    cost->key_frame_bytes = std::max(cost->key_frame_bytes, map.bytesOfKeyFrame());
  }
}

AtlasCost measureAt(const AtlasPose& pose, const AtlasRunOptions& options, AtlasCamera* camera) {
  const std::vector<std::size_t> lights = someOf(options.conditions.size());
  const auto pictures = static_cast<double>(lights.size());
  AtlasCost cost;
  Clock::time_point begin = Clock::now();
  camera->look(pose, {});
  cost.draw_s = secondsSince(begin);
  const std::unique_ptr<ObservationFile> file = scratchFile();
  const evaluate::AtlasObserver observer(options.atlas);
  begin = Clock::now();
  for (evaluate::AtlasView& view : camera->look(pose, lights)) observer.observe(std::move(view), file.get());
  cost.picture_s = std::max(0.0, secondsSince(begin) - cost.draw_s) / pictures;
  cost.picture_bytes = static_cast<double>(file->bytes()) / pictures;
  const std::size_t matched =
      std::min(static_cast<std::size_t>(options.atlas.localiser.retrieved), options.poses.size());
  const std::size_t here = std::min(matched, kMostKeyFrames);
  standForSeveral(here, pose.number, file.get());
  measureQueries(options, lights, *file, &cost);
  cost.query_s *= static_cast<double>(matched) / static_cast<double>(here);
  return cost;
}

std::string textOfBytes(double bytes) {
  const char* const units[] = {"B", "kB", "MB", "GB", "TB", "PB"};
  std::size_t unit = 0;
  for (; bytes >= 999.5 && unit < 5; ++unit) bytes /= 1000.0;
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %s", bytes, units[unit]);
  return text;
}

double freeBytes(const std::string& folder) {
  std::error_code error;
  fs::path there = fs::absolute(folder);
  while (!fs::exists(there, error) && there.has_relative_path()) there = there.parent_path();
  return static_cast<double>(fs::space(there).available);
}

double lengthOf(const std::vector<AtlasPose>& poses) {
  double length = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i)
    length += (poses[i].map_from_camera.translation() - poses[i - 1].map_from_camera.translation()).norm();
  return length;
}

}  // namespace

AtlasCost& AtlasCost::operator+=(const AtlasCost& other) {
  draw_s += other.draw_s;
  picture_s += other.picture_s;
  query_s += other.query_s;
  picture_bytes += other.picture_bytes;
  key_frame_bytes += other.key_frame_bytes;
  return *this;
}

AtlasCost& AtlasCost::operator*=(double factor) {
  for (double* const part : {&draw_s, &picture_s, &query_s, &picture_bytes, &key_frame_bytes})
    *part *= factor;
  return *this;
}

AtlasCost measureCost(const AtlasRunOptions& options, AtlasCamera* camera) {
  AtlasCost cost;
  const std::size_t places = std::min(options.poses.size(), kMostPlaces);
  camera->look(options.poses[0], {0});  // what is made but once is made
  for (std::size_t i = 0; i < places; ++i) {
    const AtlasPose& pose = options.poses[(2 * i + 1) * options.poses.size() / (2 * places)];
    cost += measureAt(pose, options, camera);
  }
  cost *= 1.0 / static_cast<double>(places);
  return cost;
}

AtlasEstimate estimateOf(const AtlasRunOptions& options, const AtlasCost& cost) {
  const auto poses = static_cast<double>(options.poses.size());
  const auto lights = static_cast<double>(options.conditions.size());
  const auto methods = static_cast<double>(options.atlas.verify.detectors.size());
  const double groups = options.unit_conditions > 0 ? std::ceil(lights / options.unit_conditions) : 1.0;
  AtlasEstimate estimate;
  estimate.observe_s = poses * (groups * cost.draw_s + lights * cost.picture_s);
  estimate.compare_s = lights * lights * poses * cost.query_s;
  estimate.observations_bytes = poses * lights * cost.picture_bytes;
  estimate.cells_bytes = lights * lights * methods * (poses * kCellRow_bytes + kCellHead_bytes);
  const double every = options.atlas.map_every_m;
  const double key_frames = every > 0.0 ? std::min(poses, lengthOf(options.poses) / every + 1.0) : poses;
  estimate.map_bytes = key_frames * cost.key_frame_bytes;
  return estimate;
}

void tellAndRequireRoom(const AtlasRunOptions& options, const AtlasFolder& folder,
                        const AtlasEstimate& estimate) {
  const double is_there = folder.bytes();
  const double needed = std::max(0.0, estimate.bytes() - is_there);
  const double free = freeBytes(options.output);
  std::printf("%.3g km of path, %zu poses, %zu lights, %zu methods: %zu pictures, %zu cells\n",
              lengthOf(options.poses) / 1000.0, options.poses.size(), options.conditions.size(),
              options.atlas.verify.detectors.size(), options.poses.size() * options.conditions.size(),
              options.conditions.size() * options.conditions.size() * options.atlas.verify.detectors.size());
  std::printf("time here, on %u processors: observe %s in %zu units, compare %s in %zu units\n",
              std::thread::hardware_concurrency(), textOfDuration(estimate.observe_s).c_str(),
              folder.observeUnits().size(), textOfDuration(estimate.compare_s).c_str(),
              folder.compareUnits().size());
  std::printf("memory: about %s for a map, beside the world\n", textOfBytes(estimate.map_bytes).c_str());
  std::printf("disk: %s of features and %s of cells, of which %s are there; free: %s\n",
              textOfBytes(estimate.observations_bytes).c_str(), textOfBytes(estimate.cells_bytes).c_str(),
              textOfBytes(is_there).c_str(), textOfBytes(free).c_str());
  if (options.atlas.localiser.retrieval != evaluate::Retrieval::kTruth)
    std::printf("comparing was measured with --retrieval truth; others look at more key frames\n");
  std::fflush(stdout);
  if (needed > free)
    throw std::runtime_error(options.output + ": the atlas needs " + textOfBytes(needed) +
                             " more, but the disk has " + textOfBytes(free) + " free");
}

}  // namespace sunlit::tools
