#include "sunlit/evaluate/localise/drive_index.h"

namespace sunlit::evaluate {

DriveIndex::DriveIndex(const std::vector<const ObservationFile*>& files, const PoseOfObservation& settled) {
  for (const ObservationFile* file : files) {
    const std::vector<ObservationKey> keys = file->keys();
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const ObservationKey& key = keys[i];
      const std::optional<std::int64_t> pose = settled(key);
      if (!pose) continue;
      const Observed observed{file, i, key.stamp_ns};
      ObservedDrive& drive = drives_[{key.stream, key.detector}];
      const auto [found, is_new] = drive.emplace(*pose, observed);
      if (!is_new && key.stamp_ns <= found->second.stamp_ns) found->second = observed;
    }
  }
}

const ObservedDrive& DriveIndex::at(const std::string& stream, const std::string& detector) const {
  static const ObservedDrive none;
  const auto found = drives_.find({stream, detector});
  return found == drives_.end() ? none : found->second;
}

ObservedMap mapOf(const DriveIndex& drives, const std::vector<std::string>& streams,
                  const MapOptions& options, const StopToken& stop) {
  ObservedMap map{std::make_unique<Localiser>(options.space, options.localiser), {}, 0, 0};
  for (const std::string& stream : streams) {
    KeyFrameSpacing spacing(options.map_every_m);
    for (const auto& [pose, place] : drives.at(stream, options.detector)) {
      stop.check();
      if (!spacing.takes(place.head().map_from_optical.translation())) continue;
      const Observation seen = place.read();
      KeyFrame frame = keyFrameOf(seen.map_from_optical, seen.features, seen.points);
      map.features += seen.features.key_points.size();
      map.points += frame.points.size();
      map.localiser->add(std::move(frame));
      map.origins.push_back({stream, pose});
    }
  }
  map.localiser->finish();
  return map;
}

}  // namespace sunlit::evaluate
