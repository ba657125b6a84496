#include "ros/tools/compare_light_options.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "ros/tools/arguments.h"
#include "ros/tools/camera_arguments.h"

namespace sunlit::tools {

namespace {

constexpr const char* kOwnHelp =
    R"(compare_light: how far the fast picture's light is from path-traced light. Needs no ROS master.

usage: compare_light --out DIR [options]

  --out DIR                      folder for table.csv, table.md, and a picture of each view and sun:
                                 fast | traced | relative error (red too bright, blue too dark, full at 50 %)
  --path FILE                    waypoints to place views along: CSV or TUM; without it the path of race_track
  --views N                      how many views along the path, 1 ... 1000 (default 10)
  --height M                     of the camera above the waypoints, -1000 ... 1000 (default 1)
  --view X,Y,Z[,YAW[,PITCH]]     a view instead of the path, m and deg, yaw counter-clockwise from east, pitch up
                                 is positive; may be repeated
  --sun AZIMUTH,ELEVATION        deg, azimuth clockwise from north; may be repeated. Default: suns at 60, 20, 4,
                                 -4 and -9, and a moon at 45 degrees
  --moon AZIMUTH,ELEVATION,PHASE deg, phase angle 0 is full; the sun is at -40 degrees; may be repeated
  --every N                      px: compares every Nth pixel across and down, 1 ... 64 (default 8), so that pixels
                                 are as small as in use and the tracing takes no hours
  --samples N                    traced paths a pixel, 2 ... 65536 (default 256)
  --bounces N                    reflections beyond the surface that is seen, 0 ... 64 (default 16)
)";

SkyToCompare skyFrom(const std::string& key, const std::string& text) {
  const std::size_t count = key == "--moon" ? 3 : 2;
  const std::vector<double> values = numbers(key, text, {count, count});
  if (std::abs(values[1]) > 90.0) reject(key, text, "of an elevation of -90 ... 90 degrees");
  std::ostringstream name;
  name << key.substr(2) << "_" << values[1];
  SkyToCompare sky{name.str(), values[0], values[1], std::nullopt};
  if (count == 3) {
    if (values[2] < 0.0 || values[2] > 180.0) reject(key, text, "of a phase angle of 0 ... 180 degrees");
    sky.moon_phase_deg = values[2];
  }
  return sky;
}

/// Pictures and tables know a sky by its name: by its azimuth too, where another has its elevation.
void add(SkyToCompare sky, std::vector<SkyToCompare>* skies) {
  const auto isThere = [&] {
    return std::any_of(skies->begin(), skies->end(),
                       [&](const SkyToCompare& other) { return other.name == sky.name; });
  };
  if (isThere()) {
    std::ostringstream azimuth;
    azimuth << sky.azimuth_deg;
    sky.name += "_at_" + azimuth.str();
  }
  if (isThere()) throw std::invalid_argument("two skies would both be called " + sky.name);
  skies->push_back(std::move(sky));
}

/// False for a key of no kind that it knows.
bool readScene(const std::string& key, const std::string& value, CompareLightOptions* options) {
  if (key == "--path") {
    options->path = value;
  } else if (key == "--views") {
    options->views = wholeWithin(key, value, 1, 1000);
  } else if (key == "--height") {
    options->height_m = numberWithin(key, value, -1000.0, 1000.0);
  } else if (key == "--view") {
    options->map_from_camera.push_back(mapFromCamera(numbers(key, value, {3, 5})));
  } else if (key == "--sun" || key == "--moon") {
    add(skyFrom(key, value), &options->skies);
  } else {
    return false;
  }
  return true;
}

bool readTracing(const std::string& key, const std::string& value, CompareLightOptions* options) {
  if (key == "--every") {
    options->every = wholeWithin(key, value, 1, 64);
  } else if (key == "--samples") {
    options->reference.samples_per_pixel = wholeWithin(key, value, 2, 65536);
  } else if (key == "--bounces") {
    options->reference.bounces = wholeWithin(key, value, 0, 64);
  } else if (key == "--out") {
    options->output = value;
  } else {
    return false;
  }
  return true;
}

}  // namespace

void printCompareLightHelp() {
  for (const char* help : {kOwnHelp, kWorldHelp, kCameraHelp, kBouncedHelp}) std::fputs(help, stdout);
}

std::optional<CompareLightOptions> parseCompareLightOptions(const std::vector<std::string>& arguments) {
  CompareLightOptions options;
  CameraWords camera;
  std::string of_path;  // an option that only views along a path give sense to
  const bool go = readArguments(arguments, [&](const std::string& key, const std::string& value) {
    if (key == "--path" || key == "--views" || key == "--height") of_path = key;
    return takeWorld(key, value, &options.world) || takeBounced(key, value, &options.world) ||
           takeCamera(key, value, &camera) || readScene(key, value, &options) ||
           readTracing(key, value, &options);
  });
  if (!go) return std::nullopt;
  if (options.output.empty()) throw std::invalid_argument("--out DIR is missing; --help lists all options");
  if (!of_path.empty() && !options.map_from_camera.empty())
    throw std::invalid_argument(of_path + " and --view are both given; one of them");
  if (options.path.empty() && options.map_from_camera.empty() && options.world.name != scene::kRaceTrack)
    throw std::invalid_argument("--path FILE or --view is missing: only race_track has a path of its own");
  if (options.skies.empty()) {
    for (const char* sun : {"170,60", "250,20", "285,4", "290,-4", "295,-9"})
      options.skies.push_back(skyFrom("--sun", sun));
    options.skies.push_back(skyFrom("--moon", "150,45,10"));
  }
  camera.requireSense(options.world);
  options.render = camera.options();
  render::validate(options.render);
  light::validate(options.reference);
  return options;
}

}  // namespace sunlit::tools
