#include "ros/tools/compare_light_options.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "ros/tools/arguments.h"

namespace sunlit::tools {

const char* const kCompareLightHelp =
    R"(compare_light: how far the fast picture's light is from path-traced light. Needs no ROS master.

usage: compare_light --out DIR [options]

  --world race_track|FILE        built-in world (default), or .world .sdf .dae .gltf .glb .obj
  --model-path DIR               where model:// is looked for; may be repeated
  --path FILE                    waypoints to place views along (default: the built-in world's)
  --views N                      how many views along the path, 1 ... 1000 (default 10)
  --height M                     of the camera above the waypoints (default 1)
  --view X,Y,Z,YAW[,PITCH]       a view instead of the path, m and deg, yaw counter-clockwise from east, pitch up
                                 is positive; may be repeated
  --sun AZIMUTH,ELEVATION        deg, azimuth clockwise from north; may be repeated. Default: suns at 60, 20, 4,
                                 -4 and -9, and a moon at 45 degrees
  --moon AZIMUTH,ELEVATION,PHASE deg, phase angle 0 is full; the sun is at -40 degrees; may be repeated
  --size WxH                     px, 16 ... 8192 (default 96x72)
  --fov DEG                      horizontal field of view (default 90)
  --supersampling N              geometry samples per pixel and axis, 1 ... 4 (default 2)
  --bake yes|no                  whether the fast picture's light is baked (default yes)
  --cache DIR                    keeps the bake for the next time
  --samples N                    traced paths a pixel (default 256)
  --bounces N                    reflections beyond the surface that is seen, 0 ... 64 (default 16)
  --out DIR                      folder for table.csv, table.md, and a picture of each view and sun:
                                 fast | traced | relative error (red too bright, blue too dark, full at 50 %)
)";

namespace {

Eigen::Isometry3d viewFrom(const std::vector<double>& pose) {
  const double pitch = pose.size() > 4 ? pose[4] : 0.0;
  Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();
  map_from_camera.linear() = (Eigen::AngleAxisd(pose[3] * kRadPerDeg, Eigen::Vector3d::UnitZ()) *
                              Eigen::AngleAxisd(-pitch * kRadPerDeg, Eigen::Vector3d::UnitY()))
                                 .toRotationMatrix();
  map_from_camera.translation() = Eigen::Vector3d(pose[0], pose[1], pose[2]);
  return map_from_camera;
}

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

/// What must be known in full before the camera can be made.
struct CameraWords {
  int width = 96, height = 72;
  double fov_deg = 90.0;
};

/// False for a key of no kind that it knows.
bool readScene(const std::string& key, const std::string& value, CompareLightOptions* options) {
  if (key == "--world") {
    options->world = value;
  } else if (key == "--model-path") {
    options->model_folders.push_back(value);
  } else if (key == "--path") {
    options->path = value;
  } else if (key == "--views") {
    options->views = wholeWithin(key, value, 1, 1000);
  } else if (key == "--height") {
    options->height_m = numberWithin(key, value, -1000.0, 1000.0);
  } else if (key == "--view") {
    options->map_from_camera.push_back(viewFrom(numbers(key, value, {4, 5})));
  } else if (key == "--sun" || key == "--moon") {
    add(skyFrom(key, value), &options->skies);
  } else {
    return false;
  }
  return true;
}

bool readPicture(const std::string& key, const std::string& value, CameraWords* words,
                 CompareLightOptions* options) {
  if (key == "--size") {
    const std::vector<double> size = numbers(key, value, {2, 2}, 'x');
    for (const double side : size) {
      if (side != std::floor(side) || side < 16 || side > 8192)
        reject(key, value, "WIDTHxHEIGHT, whole numbers of 16 ... 8192 px");
    }
    words->width = static_cast<int>(size[0]);
    words->height = static_cast<int>(size[1]);
  } else if (key == "--fov") {
    words->fov_deg = numberWithin(key, value, 0.1, 170.0);
  } else if (key == "--supersampling") {
    options->render.supersampling = wholeWithin(key, value, 1, 4);
  } else if (key == "--bake") {
    if (value != "yes" && value != "no") reject(key, value, "yes or no");
    options->bake = value == "yes";
  } else if (key == "--cache") {
    options->cache = value;
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

std::optional<CompareLightOptions> parseCompareLightOptions(const std::vector<std::string>& arguments) {
  CompareLightOptions options;
  CameraWords words;
  const bool go = readArguments(arguments, [&](const std::string& key, const std::string& value) {
    return readScene(key, value, &options) || readPicture(key, value, &words, &options);
  });
  if (!go) return std::nullopt;
  if (options.output.empty()) throw std::invalid_argument("--out DIR is missing; --help lists all options");
  if (options.path.empty() && options.map_from_camera.empty() && options.world != "race_track")
    throw std::invalid_argument("--path FILE or --view is missing: only race_track has a path of its own");
  if (options.skies.empty()) {
    for (const char* sun : {"170,60", "250,20", "285,4", "290,-4", "295,-9"})
      options.skies.push_back(skyFrom("--sun", sun));
    options.skies.push_back(skyFrom("--moon", "150,45,10"));
  }
  options.render.camera =
      image::PinholeCamera::fromFieldOfView(words.width, words.height, Angle::degrees(words.fov_deg));
  render::validate(options.render);
  light::validate(options.reference);
  return options;
}

}  // namespace sunlit::tools
