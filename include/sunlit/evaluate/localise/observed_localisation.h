/// Queries of a run looked for in the map of the same run, once all of both has been observed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sunlit/evaluate/localise/drive_index.h"
#include "sunlit/evaluate/localise/localisation.h"
#include "sunlit/evaluate/localise/localisation_files.h"
#include "sunlit/evaluate/localise/observations.h"
#include "sunlit/evaluate/stop_token.h"

namespace sunlit::evaluate {

/// Which streams, of those observed.
struct ObservedStreams {
  std::vector<std::string> map;  ///< key frames of the first come first
  std::vector<std::string> queries;
};

struct ObservedProgress {
  /// `done` of `all` queries; one of each detector counts. Called by one thread at a time.
  std::function<void(std::size_t done, std::size_t all)> update;
  std::function<void(const LocalisationRow& row)> found;  ///< by one thread at a time, in no certain order
  StopToken stop;
};

struct ObservedDrives {
  std::vector<const ObservationFile*> files;
  ObservedStreams streams;
  PoseOfObservation settled;
};

/// Pictures, by stream and pose.
using StreamPoses = std::set<std::pair<std::string, std::int64_t>>;

struct ObservedResult {
  std::size_t key_frames = 0;  ///< of the detector that has most: one that threw lacks some
  std::vector<std::string>
      unplaced;        ///< detectors that found features in the map, of which depth placed none
  StreamPoses to_map;  ///< those that key frames were chosen from
  std::vector<LocalisationRow> rows;  ///< none without a key frame
};

/// The same rows as Localisation gives for the pictures themselves, by query stream, pose and detector, in
/// the order of `observed.streams` and `options`. Key frames are chosen of each
/// stream of the map for itself, in the order of their poses. Of a
/// pose that was observed twice the earlier stamp counts, of one stamp the last. Runs in parallel, to the
/// same bits. Throws Stopped.
ObservedResult localiseObserved(const ObservedDrives& observed, const LocalisationOptions& options,
                                const ObservedProgress& progress);

}  // namespace sunlit::evaluate
