// count_poses WORLD WAYPOINT_FILE SPACING_M POSES: prints how many poses an experiment has, which is POSES,
// or all of the path where POSES is 0. WAYPOINT_FILE is empty for the path of the built-in world. What cannot
// be is one line on stderr and exit status 1, so that a launch file that asks stops before it has started
// anything.
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>

#include "sunlit/path/path.h"
#include "sunlit/scene/load.h"
#include "sunlit/scene/race_track.h"

namespace {

using namespace sunlit;

std::size_t countPoses(const std::string& world, const std::string& file, const std::string& spacing,
                       const std::string& poses) {
  path::PathOptions options;
  std::size_t wanted = 0;
  try {
    options.spacing_m = std::stod(spacing);
    const int number = std::stoi(poses);
    if (number < 0 || std::to_string(number) != poses) throw std::out_of_range(poses);
    wanted = static_cast<std::size_t>(number);
  } catch (const std::logic_error&) {
    throw std::invalid_argument("argument spacing is \"" + spacing + "\" and poses is \"" + poses +
                                "\", but they must be a number of metres and a whole number of at least 0");
  }
  path::validate(options);
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
    std::cerr << "experiment: " << error.what() << '\n';
    return 1;
  }
}
