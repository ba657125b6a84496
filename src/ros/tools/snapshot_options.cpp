#include "ros/tools/snapshot_options.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "sunlit/quantity/direction.h"
#include "sunlit/quantity/frames.h"

namespace sunlit::tools {

const char* const kSnapshotHelp = R"(snapshot: one picture of a world under a given sun. Needs no ROS master.

usage: snapshot --out FILE.png [options]

  --world race_track|FILE        built-in world (default), or .world .sdf .dae .gltf .glb .obj
  --model-path DIR               where model:// is looked for; may be repeated
  --pose X,Y,Z[,YAW[,PITCH]]     camera in map, m and deg; yaw counter-clockwise from east, pitch up is positive
                                 (default 0,0,1,0,0)
  --look-at X,Y,Z                turns the camera of --pose towards this point instead of by yaw and pitch
  --top-down X,Y,EXTENT          view from straight above, north up: EXTENT m wide about X,Y
  --sun AZIMUTH,ELEVATION        deg; azimuth clockwise from north (default 180,40)
  --ev auto|NUMBER               exposure value at ISO 100 (default auto)
  --size WxH                     px (default 640x480)
  --fov DEG                      horizontal field of view (default 90)
  --supersampling N              samples per pixel and axis, 1 ... 4 (default 2)
  --depth FILE.pfm               depth too: portable float map, m along the optical axis, NaN where there is none
  --out FILE.png                 the picture
)";

namespace {

[[noreturn]] void reject(const std::string& option, const std::string& value, const std::string& allowed) {
  throw std::invalid_argument(option + " is \"" + value + "\", must be " + allowed);
}

/// `text` as between `least` and `most` numbers separated by `separator`.
std::vector<double> numbers(const std::string& option, const std::string& text,
                            std::pair<std::size_t, std::size_t> count, char separator = ',') {
  const std::string wanted =
      (count.first == count.second ? std::to_string(count.first)
                                   : std::to_string(count.first) + " to " + std::to_string(count.second)) +
      " number(s) separated by '" + separator + "'";
  std::vector<double> values;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, separator);) {
    std::size_t used = 0;
    double value = 0.0;
    try {
      value = std::stod(part, &used);
    } catch (const std::exception&) {
      reject(option, text, wanted);
    }
    if (used != part.size() || !std::isfinite(value)) reject(option, text, wanted);
    values.push_back(value);
  }
  if (values.size() < count.first || values.size() > count.second) reject(option, text, wanted);
  return values;
}

double numberWithin(const std::string& option, const std::string& text, double low, double high) {
  const double value = numbers(option, text, {1, 1})[0];
  if (value < low || value > high) {
    std::ostringstream range;
    range << low << " ... " << high;
    reject(option, text, range.str());
  }
  return value;
}

int wholeWithin(const std::string& option, const std::string& text, int low, int high) {
  const double value = numberWithin(option, text, low, high);
  if (value != std::floor(value)) reject(option, text, "a whole number");
  return static_cast<int>(value);
}

/// x forward, y left, z up.
Eigen::Matrix3d mapFromLink(double yaw_rad, double pitch_up_rad) {
  return (Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(-pitch_up_rad, Eigen::Vector3d::UnitY()))
      .toRotationMatrix();
}

/// What must be known in full before the camera can be placed.
struct CameraWords {
  std::vector<double> pose = {0.0, 0.0, 1.0, 0.0, 0.0};
  std::vector<double> look_at, top_down;  ///< empty if not given
  int width = 640, height = 480;
  double fov_deg = 90.0;
};

void placeTopDown(const CameraWords& words, SnapshotOptions* options) {
  const std::vector<double>& t = words.top_down;
  if (t[2] <= 0.0) throw std::invalid_argument("--top-down: the extent must be above 0 m");
  // From so far up that the picture is close to a map: parallel rays within 3 degrees.
  const double height = 10.0 * t[2];
  image::PinholeCamera& camera = options->render.camera;
  camera =
      image::PinholeCamera::fromFieldOfView(words.width, words.height, Angle::radians(2.0 * std::atan(0.05)));
  options->top_down_height_m = height;
  options->render.near_m = 0.5 * height;
  options->render.far_m = 2.0 * height;
  options->map_from_optical.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  options->map_from_optical.translation() = Eigen::Vector3d(t[0], t[1], height);
}

void placeCamera(const CameraWords& words, SnapshotOptions* options) {
  options->render.camera =
      image::PinholeCamera::fromFieldOfView(words.width, words.height, Angle::degrees(words.fov_deg));
  if (!words.top_down.empty()) {
    placeTopDown(words, options);
    return;
  }
  std::vector<double> pose = words.pose;
  pose.resize(5, 0.0);
  const Eigen::Vector3d eye(pose[0], pose[1], pose[2]);
  double yaw = pose[3] * kRadPerDeg, pitch = pose[4] * kRadPerDeg;
  if (!words.look_at.empty()) {
    const Eigen::Vector3d towards =
        Eigen::Vector3d(words.look_at[0], words.look_at[1], words.look_at[2]) - eye;
    if (towards.norm() < 1e-6) throw std::invalid_argument("--look-at is where the camera stands");
    yaw = std::atan2(towards.y(), towards.x());
    pitch = std::atan2(towards.z(), towards.head<2>().norm());
  }
  options->map_from_optical.linear() = mapFromLink(yaw, pitch) * linkFromOptical().linear();
  options->map_from_optical.translation() = eye;
}

void readOption(const std::string& key, const std::string& value, CameraWords* words,
                SnapshotOptions* options) {
  if (key == "--world") {
    options->world = value;
  } else if (key == "--model-path") {
    options->model_folders.push_back(value);
  } else if (key == "--pose") {
    words->pose = numbers(key, value, {3, 5});
  } else if (key == "--look-at") {
    words->look_at = numbers(key, value, {3, 3});
  } else if (key == "--top-down") {
    words->top_down = numbers(key, value, {3, 3});
  } else if (key == "--sun") {
    const std::vector<double> sun = numbers(key, value, {2, 2});
    if (std::abs(sun[1]) > 90.0) reject(key, value, "azimuth, and an elevation of -90 ... 90 degrees");
    options->sun_azimuth = Angle::degrees(sun[0]);
    options->sun_elevation = Angle::degrees(sun[1]);
  } else if (key == "--ev") {
    options->exposure.mode = value == "auto" ? image::ExposureMode::kAuto : image::ExposureMode::kFixed;
    if (value != "auto") options->exposure.ev100 = numberWithin(key, value, -16.0, 24.0);
  } else if (key == "--size") {
    const std::vector<double> size = numbers(key, value, {2, 2}, 'x');
    words->width = static_cast<int>(size[0]);
    words->height = static_cast<int>(size[1]);
  } else if (key == "--fov") {
    words->fov_deg = numberWithin(key, value, 0.1, 170.0);
  } else if (key == "--supersampling") {
    options->render.supersampling = wholeWithin(key, value, 1, 4);
  } else if (key == "--depth") {
    options->depth_output = value;
  } else if (key == "--out") {
    options->output = value;
  } else {
    throw std::invalid_argument("unknown option " + key + "; --help lists all");
  }
}

}  // namespace

std::optional<SnapshotOptions> parseSnapshotOptions(const std::vector<std::string>& arguments) {
  SnapshotOptions options;
  CameraWords words;
  for (std::size_t i = 0; i < arguments.size(); i += 2) {
    if (arguments[i] == "--help" || arguments[i] == "-h") return std::nullopt;
    if (i + 1 == arguments.size())
      throw std::invalid_argument(arguments[i] + " needs a value; --help lists all options");
    readOption(arguments[i], arguments[i + 1], &words, &options);
  }
  if (options.output.empty()) throw std::invalid_argument("--out FILE is missing; --help lists all options");
  placeCamera(words, &options);
  render::validate(options.render);
  return options;
}

}  // namespace sunlit::tools
