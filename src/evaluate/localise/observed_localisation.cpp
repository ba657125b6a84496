#include "sunlit/evaluate/localise/observed_localisation.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <tuple>
#include <utility>

namespace sunlit::evaluate {
namespace {

struct Query {
  std::size_t stream;
  std::size_t detector;
  std::int64_t pose;
  Observed place;
  auto order() const { return std::tie(stream, pose, detector); }
};

/// In the order of their rows.
std::vector<Query> queriesIn(const DriveIndex& drives, const ObservedStreams& streams,
                             const std::vector<std::string>& detectors) {
  std::vector<Query> queries;
  for (std::size_t s = 0; s < streams.queries.size(); ++s) {
    for (std::size_t d = 0; d < detectors.size(); ++d) {
      for (const auto& [pose, place] : drives.at(streams.queries[s], detectors[d]))
        queries.push_back({s, d, pose, place});
    }
  }
  std::sort(queries.begin(), queries.end(),
            [](const Query& a, const Query& b) { return a.order() < b.order(); });
  return queries;
}

StreamPoses picturesToMap(const DriveIndex& drives, const std::vector<std::string>& streams,
                          const std::vector<std::string>& detectors) {
  StreamPoses pictures;
  for (const std::string& stream : streams) {
    for (const std::string& detector : detectors) {
      for (const auto& [pose, place] : drives.at(stream, detector)) pictures.emplace(stream, pose);
    }
  }
  return pictures;
}

}  // namespace

ObservedResult localiseObserved(const ObservedDrives& observed, const LocalisationOptions& options,
                                const ObservedProgress& progress) {
  const ObservedStreams& streams = observed.streams;
  const DriveIndex drives(observed.files, observed.settled);
  std::vector<ObservedMap> maps;
  for (const std::string& detector : options.detectors)
    maps.push_back(
        mapOf(drives, streams.map,
              {detector, detectorOf(options, detector).space(), options.map_every_m, options.localiser},
              progress.stop));
  ObservedResult result;
  result.to_map = picturesToMap(drives, streams.map, options.detectors);
  for (std::size_t d = 0; d < maps.size(); ++d) {
    result.key_frames = std::max(result.key_frames, maps[d].origins.size());
    if (maps[d].features > 0 && maps[d].points == 0) result.unplaced.push_back(options.detectors[d]);
  }
  if (result.key_frames == 0) return result;
  const std::vector<Query> queries = queriesIn(drives, streams, options.detectors);
  result.rows.resize(queries.size());
  std::mutex mutex;
  std::size_t done = 0;
  tbb::parallel_for(std::size_t{0}, queries.size(), [&](std::size_t q) {
    progress.stop.check();
    const Query& query = queries[q];
    const Observation observation = query.place.read();
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
