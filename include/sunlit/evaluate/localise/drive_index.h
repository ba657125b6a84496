/// Observations of a drive, found by their poses, and the map that is made of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sunlit/evaluate/localise/localiser.h"
#include "sunlit/evaluate/localise/observations.h"
#include "sunlit/evaluate/stop_token.h"

namespace sunlit::evaluate {

/// The number that counts of the pose of an observation; nothing where it does not count.
using PoseOfObservation = std::function<std::optional<std::int64_t>(const ObservationKey& key)>;

/// Where an observation is.
struct Observed {
  const ObservationFile* file;
  std::size_t index;
  std::int64_t stamp_ns;

  Observation read() const { return file->read(index); }
  ObservationHead head() const { return file->head(index); }
};

/// What one detector found along one drive, by number of the pose.
using ObservedDrive = std::map<std::int64_t, Observed>;

class DriveIndex {
 public:
  /// Of a pose that was observed twice the earlier stamp counts, of one stamp the last: of a run that was
  /// taken up, since the one before was not good. The files outlive this.
  DriveIndex(const std::vector<const ObservationFile*>& files, const PoseOfObservation& settled);
  /// Of `stream` by `detector`; empty where there is none.
  const ObservedDrive& at(const std::string& stream, const std::string& detector) const;

 private:
  std::map<std::pair<std::string, std::string>, ObservedDrive> drives_;
};

/// How key frames are made and looked into.
struct MapOptions {
  std::string detector;      ///< by its name
  DescriptorSpace space;     ///< of its descriptors
  double map_every_m = 5.0;  ///< for KeyFrameSpacing
  LocaliserOptions localiser;
};

/// A map, and where its key frames were taken, one by one.
struct ObservedMap {
  std::unique_ptr<Localiser> localiser;
  std::vector<KeyFrameOrigin> origins;
  std::size_t features = 0, points = 0;  ///< found in them, and of these such as their depth places
};

/// Of the drive of each stream the first, and one every map_every_m; finished. Of other poses no features are
/// read. Throws Stopped.
ObservedMap mapOf(const DriveIndex& drives, const std::vector<std::string>& streams,
                  const MapOptions& options, const StopToken& stop = {});

}  // namespace sunlit::evaluate
