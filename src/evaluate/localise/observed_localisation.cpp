#include "sunlit/evaluate/localise/observed_localisation.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <tuple>
#include <utility>

namespace sunlit::evaluate {
namespace {

/// Where an observation is.
struct Observed {
  const ObservationFile* file;
  std::size_t index;
  std::int64_t stamp_ns;
};
/// By number of the pose.
using Drive = std::map<std::int64_t, Observed>;
/// By stream and detector.
using Drives = std::map<std::pair<std::string, std::string>, Drive>;

Drives drivesOf(const std::vector<const ObservationFile*>& files, const PoseOfStamp& settled) {
  Drives drives;
  for (const ObservationFile* file : files) {
    const std::vector<ObservationKey> keys = file->keys();
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const ObservationKey& key = keys[i];
      const Observed observed{file, i, key.stamp_ns};
      Drive& drive = drives[{key.stream, key.detector}];
      const auto [found, is_new] = drive.emplace(settled(key.stamp_ns, key.pose), observed);
      if (!is_new && key.stamp_ns < found->second.stamp_ns) found->second = observed;
    }
  }
  return drives;
}

const Drive& driveOf(const Drives& drives, const std::string& stream, const std::string& detector) {
  static const Drive none;
  const auto found = drives.find({stream, detector});
  return found == drives.end() ? none : found->second;
}

struct Query {
  std::size_t stream;
  std::size_t detector;
  std::int64_t pose;
  Observed place;
  auto order() const { return std::tie(stream, pose, detector); }
};

/// A map, and where its key frames were taken, one by one.
struct ObservedMap {
  std::unique_ptr<Localiser> localiser;
  std::vector<KeyFrameOrigin> origins;
};

struct DriveOfMap {
  std::string stream;
  const Drive* drive;
};

std::vector<DriveOfMap> drivesOfMap(const Drives& drives, const std::vector<std::string>& streams,
                                    const std::string& detector) {
  std::vector<DriveOfMap> found;
  for (const std::string& stream : streams) found.push_back({stream, &driveOf(drives, stream, detector)});
  return found;
}

/// Of each drive the first, and one every map_every_m.
ObservedMap mapOf(const std::vector<DriveOfMap>& drives, const std::string& detector,
                  const LocalisationOptions& options, const StopToken& stop) {
  ObservedMap map{
      std::make_unique<Localiser>(detector, detectorOf(options, detector).norm(), options.localiser), {}};
  for (const auto& [stream, drive] : drives) {
    KeyFrameSpacing spacing(options.map_every_m);
    for (const auto& [pose, place] : *drive) {
      stop.check();
      const Observation seen = place.file->read(place.index);
      if (!spacing.takes(seen.map_from_optical.translation())) continue;
      map.localiser->add(keyFrameOf(seen.map_from_optical, seen.features, seen.points));
      map.origins.push_back({stream, pose});
    }
  }
  if (!map.localiser->frames().empty()) map.localiser->finish();
  return map;
}

/// In the order of their rows.
std::vector<Query> queriesIn(const Drives& drives, const ObservedStreams& streams,
                             const std::vector<std::string>& detectors) {
  std::vector<Query> queries;
  for (std::size_t s = 0; s < streams.queries.size(); ++s) {
    for (std::size_t d = 0; d < detectors.size(); ++d) {
      for (const auto& [pose, place] : driveOf(drives, streams.queries[s], detectors[d]))
        queries.push_back({s, d, pose, place});
    }
  }
  std::sort(queries.begin(), queries.end(),
            [](const Query& a, const Query& b) { return a.order() < b.order(); });
  return queries;
}

}  // namespace

ObservedResult localiseObserved(const ObservedDrives& observed, const LocalisationOptions& options,
                                const ObservedProgress& progress) {
  const ObservedStreams& streams = observed.streams;
  const Drives drives = drivesOf(observed.files, observed.settled);
  std::vector<ObservedMap> maps;
  for (const std::string& detector : options.detectors)
    maps.push_back(mapOf(drivesOfMap(drives, streams.map, detector), detector, options, progress.stop));
  ObservedResult result;
  result.key_frames = maps.at(0).origins.size();
  if (result.key_frames == 0) return result;
  const std::vector<Query> queries = queriesIn(drives, streams, options.detectors);
  result.rows.resize(queries.size());
  std::mutex mutex;
  std::size_t done = 0;
  tbb::parallel_for(std::size_t{0}, queries.size(), [&](std::size_t q) {
    progress.stop.check();
    const Query& query = queries[q];
    const Observation observation = query.place.file->read(query.place.index);
    LocalisationRow& row = result.rows[q];
    row.pose = static_cast<std::size_t>(query.pose);
    row.stamp_ns = query.place.stamp_ns;
    row.map = nameOfMap(streams.map);
    row.query = streams.queries[query.stream];
    row.detector = options.detectors[query.detector];
    const ObservedMap& map = maps[query.detector];
    row.result =
        map.localiser->localise({observation.features, observation.camera, observation.map_from_optical});
    row.truth = observation.map_from_optical;
    row.key_frame = originOf(row.result, map.origins);
    const std::lock_guard<std::mutex> lock(mutex);
    if (progress.found) progress.found(row);
    if (progress.update) progress.update(++done, queries.size());
  });
  return result;
}

}  // namespace sunlit::evaluate
