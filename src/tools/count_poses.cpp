// How many poses an experiment has, so that a launch file that asks stops before it has started anything
// where that cannot be.
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "sunlit/path/path.h"
#include "sunlit/quantity/memory.h"
#include "sunlit/scene/load.h"
#include "sunlit/scene/race_track.h"
#include "sunlit/studio/command_line.h"

namespace {

using namespace sunlit;

constexpr const char* kUsage = "usage: count_poses WORLD WAYPOINT_FILE SPACING_M POSES [MODEL_PATH...]\n";

constexpr int kNeeded = 4;  ///< words

struct CountOptions {
  path::PathOptions sampling;
  std::size_t poses = 0;
};

std::vector<Field> fieldsOf(CountOptions& options) {
  return {fieldOf(fieldsOf(options.sampling), "spacing"),
          {"poses", &options.poses, "", {0, 1e9}, "wanted; 0: all of the path"}};
}

void printHelp() {
  CountOptions options;
  const std::vector<Field> rows = fieldsOf(options);
  std::cout << "count_poses: prints how many poses an experiment has. Needs no ROS master.\n\n"
            << kUsage << '\n';
  std::cout << "  WORLD          as snapshot has it\n"
               "  WAYPOINT_FILE  CSV or TUM; empty: the path of race_track\n"
               "  SPACING_M      "
            << studio::Option("spacing", rows[0].doc, {rows[0]}).help() << '\n'
            << "  POSES          " << studio::Option("poses", rows[1].doc, {rows[1]}).help() << '\n'
            << "  MODEL_PATH     folders searched for model:// addresses, after that of the file\n";
}

/// `words`: as kUsage has them.
std::size_t countPoses(const std::vector<std::string>& words) {
  const std::string &world = words[0], &file = words[1], &spacing = words[2], &poses = words[3];
  const std::vector<std::string> model_path(words.begin() + kNeeded, words.end());
  CountOptions options;
  const std::vector<Field> rows = fieldsOf(options);
  fieldOf(rows, "spacing").setText(spacing, "argument spacing");
  fieldOf(rows, "poses").setText(poses, "argument poses");
  scene::requireWorld(world, scene::SearchPath::withEnvironment(model_path));
  if (file.empty() && world != scene::kRaceTrack) {
    throw std::invalid_argument("argument path is empty, but only the world " +
                                std::string(scene::kRaceTrack) +
                                " has a path of its own; give a waypoint file");
  }
  const path::Waypoints waypoints = file.empty() ? scene::raceTrackWaypoints() : path::readWaypoints(file);
  const std::size_t all = path::posesAlong(waypoints, options.sampling).size();
  if (options.poses > all) {
    throw std::invalid_argument("argument poses is " + poses + ", but the path has only " +
                                std::to_string(all));
  }
  return options.poses == 0 ? all : options.poses;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && (argv[1] == std::string("--help") || argv[1] == std::string("-h"))) {
    printHelp();
    return 0;
  }
  if (argc <= kNeeded) {
    std::cerr << kUsage;
    return 2;
  }
  try {
    std::cout << countPoses({argv + 1, argv + argc}) << '\n';
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "sunlit: " << reasonInWords(error) << '\n';
    return 1;
  }
}
