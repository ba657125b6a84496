// Waypoints, and the poses along them.
#include "fuzz/reader.h"
#include "sunlit/path/path.h"
#include "support/temporary_folder.h"

namespace sunlit::fuzz {

std::vector<std::string> seeds() {
  return {
      contentOf(SUNLIT_SOURCE_DIR "/test/support/worlds/straight.csv"),
      "x,y,z\n# a corner\n0,0,0\n10.5,0,0.5\n10.5,-7,1\n", "X, Y\n0,0\n1,1\n2,1\n",
      "# timestamp tx ty tz qx qy qz qw\n1.0 0 0 0 0 0 0 1\n2.0 5 0 0 0 0 0 1\n3.5 5 5 0.5 0 0 0.7 0.7\n"};
}

void read(const std::string& input) {
  setContent("./input.csv", input);
  const path::Waypoints points = path::readWaypoints("input.csv");
  path::PathOptions options;
  options.spacing_m = 100.0;  // slips of a number lead around the Earth
  std::string fault;
  try {
    path::posesAlong(points, options);
  } catch (const std::invalid_argument& error) {
    // All but how many poses there are is checked as the file is read.
    if (std::string(error.what()).find("poses") == std::string::npos) throw;
  }
}

std::string named() {
  return "input.csv";
}

}  // namespace sunlit::fuzz
