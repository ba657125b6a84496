#include "tools/path_arguments.h"

#include <cstdio>
#include <stdexcept>

#include "sunlit/scene/load.h"
#include "sunlit/scene/race_track.h"

namespace sunlit::tools {

std::string pathDoc(const std::string& what) {
  return what +
         ": CSV or TUM, whose z is taken for the ground's (a camera's own trajectory needs --height 0); "
         "without it the path of race_track";
}

path::Waypoints waypointsOf(const std::string& file) {
  if (file.empty()) return scene::raceTrackWaypoints();
  return path::readWaypoints(file,
                             [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); });
}

void addPath(studio::CommandLine* line, PathWords* words) {
  line->group("Path");
  line->add("--path FILE", {"path", &words->file, "", {}, pathDoc("waypoints")});
  const std::vector<Field> sampling = fieldsOf(words->sampling);
  line->add("--spacing M", fieldOf(sampling, "spacing"));
  line->add("--height M", fieldOf(sampling, "camera_height"));
  const std::vector<Field> selection = fieldsOf(words->selection);
  line->add("--first N", fieldOf(selection, "first"));
  line->add("--count N", fieldOf(selection, "count"));
  line->add("--stride N", fieldOf(selection, "stride"));
}

path::Waypoints waypointsOf(const PathWords& words, const studio::WorldOptions& world) {
  studio::requireWorld(world);
  if (words.file.empty() && world.name != scene::kRaceTrack)
    throw std::invalid_argument(std::string("--path FILE is missing: only the world ") + scene::kRaceTrack +
                                " has a path of its own");
  path::Waypoints waypoints = waypointsOf(words.file);
  const std::string crowded = words.selection.stride > 1 ? "" : path::crowdedText(waypoints, words.sampling);
  if (!crowded.empty()) std::fprintf(stderr, "warning: %s\n", crowded.c_str());
  return waypoints;
}

std::vector<Eigen::Isometry3d> posesAlong(const path::Waypoints& waypoints, const PathWords& words) {
  std::vector<Eigen::Isometry3d> poses = path::posesAlong(waypoints, words.sampling);
  path::requireWithin(words.selection, static_cast<int>(poses.size()), "--");
  return poses;
}

std::vector<Eigen::Isometry3d> posesOf(const PathWords& words, const studio::WorldOptions& world) {
  return posesAlong(waypointsOf(words, world), words);
}

}  // namespace sunlit::tools
