// count_poses WORLD WAYPOINT_FILE SPACING_M POSES: prints how many poses an experiment has, which is POSES,
// or all of the path where POSES is 0. WAYPOINT_FILE is empty for the path of the built-in world. What cannot
// be is one line on stderr and exit status 1, so that a launch file that asks stops before it has started
// anything.
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>

#include "ros/tools/arguments.h"
#include "sunlit/path/path.h"
#include "sunlit/scene/load.h"
#include "sunlit/scene/race_track.h"

namespace {

using namespace sunlit;

std::size_t countPoses(const std::string& world, const std::string& file, const std::string& spacing,
                       const std::string& poses) {
  path::PathOptions options;
  options.spacing_m = tools::numberWithin("argument spacing", spacing, 0.001, 1000.0);
  const auto wanted = static_cast<std::size_t>(tools::wholeWithin("argument poses", poses, 0, 1000000000));
  if (file.empty() && world != scene::kRaceTrack) {
    throw std::invalid_argument("argument path is empty, but only the world " +
                                std::string(scene::kRaceTrack) +
                                " has a path of its own; give a waypoint file");
  }
  const path::Waypoints waypoints = file.empty() ? scene::raceTrackWaypoints() : path::readWaypoints(file);
  const std::size_t all = path::posesAlong(waypoints, options).size();
  if (wanted > all) {
    throw std::invalid_argument("argument poses is " + poses + ", but the path has only " +
                                std::to_string(all));
  }
  return wanted == 0 ? all : wanted;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "usage: count_poses WORLD WAYPOINT_FILE SPACING_M POSES\n";
    return 2;
  }
  try {
    std::cout << countPoses(argv[1], argv[2], argv[3], argv[4]) << '\n';
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "sunlit: " << error.what() << '\n';
    return 1;
  }
}
