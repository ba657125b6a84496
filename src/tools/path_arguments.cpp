#include "tools/path_arguments.h"

#include <stdexcept>

#include "sunlit/scene/load.h"
#include "sunlit/scene/race_track.h"

namespace sunlit::tools {

void addPath(studio::CommandLine* line, PathWords* words) {
  line->group("Path");
  line->add("--path FILE",
            {"path", &words->file, "", {}, "waypoints: CSV or TUM; without it the path of race_track"});
  const std::vector<Field> sampling = fieldsOf(words->sampling);
  line->add("--spacing M", fieldOf(sampling, "spacing"));
  line->add("--height M", fieldOf(sampling, "camera_height"));
  const std::vector<Field> selection = fieldsOf(words->selection);
  line->add("--first N", fieldOf(selection, "first"));
  line->add("--count N", fieldOf(selection, "count"));
  line->add("--stride N", fieldOf(selection, "stride"));
}

std::vector<Eigen::Isometry3d> posesOf(const PathWords& words, const studio::WorldOptions& world) {
  studio::requireWorld(world);
  const bool built_in = words.file.empty();
  if (built_in && world.name != scene::kRaceTrack)
    throw std::invalid_argument(std::string("--path FILE is missing: only the world ") + scene::kRaceTrack +
                                " has a path of its own");
  const path::Waypoints waypoints = built_in ? scene::raceTrackWaypoints() : path::readWaypoints(words.file);
  std::vector<Eigen::Isometry3d> poses = path::posesAlong(waypoints, words.sampling);
  path::requireWithin(words.selection, static_cast<int>(poses.size()), "--");
  return poses;
}

}  // namespace sunlit::tools
