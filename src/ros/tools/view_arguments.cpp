#include "ros/tools/view_arguments.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "ros/tools/arguments.h"
#include "sunlit/path/path.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/scene/load.h"
#include "sunlit/scene/race_track.h"

namespace sunlit::tools {

const char* const kViewHelp =
    R"(  --world race_track|FILE        built-in world (default), or .world .sdf .dae .gltf .glb .obj
  --model-path DIR               where model:// is looked for; may be repeated
  --pose X,Y,Z[,YAW[,PITCH]]     camera in map, m and deg; yaw counter-clockwise from east, pitch up is positive
                                 (default 0,0,1,0,0)
  --look-at X,Y,Z                turns the camera of --pose towards this point instead of by yaw and pitch
  --path-pose N                  pose N along the path, sampled every 1 m, 1 m above it, instead of --pose
  --path FILE                    that path: CSV or TUM; without it the path of race_track
  --top-down X,Y,EXTENT          view from straight above, north up: EXTENT m wide about X,Y
  --size WxH                     px (default 640x480)
  --fov DEG                      horizontal field of view (default 90)
  --supersampling N              samples per pixel and axis, 1 ... 4 (default 2)
  --ev auto|NUMBER               exposure value at ISO 100 (default auto)
  --compensation STOPS           of --ev auto: brighter (+) or darker (-), -8 ... 8 (default 0)
  --bounced on|off               light that surfaces hide and pass on; off: each sees the whole sky (default on)
  --cache DIR                    where that is kept for the next time (default ~/.cache/sunlit)
  --noise SEED                   adds the noise of a sensor, with this seed, 0 ... 2147483647 (default none)
)";

namespace {

/// x forward, y left, z up.
Eigen::Matrix3d mapFromLink(double yaw_rad, double pitch_up_rad) {
  return (Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(-pitch_up_rad, Eigen::Vector3d::UnitY()))
      .toRotationMatrix();
}

}  // namespace

bool ViewArguments::take(const std::string& key, const std::string& value) {
  if (key == "--world") {
    options_.world = value;
  } else if (key == "--model-path") {
    options_.model_folders.push_back(value);
  } else if (key == "--bounced") {
    if (value != "on" && value != "off") reject(key, value, "on or off");
    options_.bounced = value == "on";
  } else if (key == "--cache") {
    options_.cache = value;
  } else {
    return takeCamera(key, value) || takeSensor(key, value);
  }
  return true;
}

bool ViewArguments::takeCamera(const std::string& key, const std::string& value) {
  if (key == "--pose") {
    pose_ = numbers(key, value, {3, 5});
  } else if (key == "--look-at") {
    look_at_ = numbers(key, value, {3, 3});
  } else if (key == "--top-down") {
    top_down_ = numbers(key, value, {3, 3});
    if (top_down_[2] <= 0.0) throw std::invalid_argument("--top-down: the extent must be above 0 m");
  } else if (key == "--path-pose") {
    path_pose_ = wholeWithin(key, value, 0, std::numeric_limits<int>::max());
  } else if (key == "--path") {
    path_file_ = value;
  } else {
    return false;
  }
  return true;
}

bool ViewArguments::takeSensor(const std::string& key, const std::string& value) {
  if (key == "--size") {
    const std::vector<double> size = numbers(key, value, {2, 2}, 'x');
    for (const double side : size) {
      if (side != std::floor(side) || side < 16 || side > 8192)
        reject(key, value, "WIDTHxHEIGHT, whole numbers of 16 ... 8192 px");
    }
    width_ = static_cast<int>(size[0]);
    height_ = static_cast<int>(size[1]);
  } else if (key == "--fov") {
    fov_deg_ = numberWithin(key, value, 0.1, 170.0);
  } else if (key == "--supersampling") {
    options_.render.supersampling = wholeWithin(key, value, 1, 4);
  } else if (key == "--ev") {
    options_.exposure.mode = value == "auto" ? image::ExposureMode::kAuto : image::ExposureMode::kFixed;
    if (value != "auto") options_.exposure.ev100 = numberWithin(key, value, -16.0, 24.0);
  } else if (key == "--compensation") {
    options_.exposure.compensation_ev = numberWithin(key, value, -8.0, 8.0);
  } else if (key == "--noise") {
    options_.noise.enabled = true;
    options_.noise.seed = wholeWithin(key, value, 0, std::numeric_limits<int>::max());
  } else {
    return false;
  }
  return true;
}

void ViewArguments::placeTopDown(ViewOptions* options) const {
  // From so far up that the picture is close to a map: parallel rays within 3 degrees.
  const double height = 10.0 * top_down_[2];
  options->render.camera =
      image::PinholeCamera::fromFieldOfView(width_, height_, Angle::radians(2.0 * std::atan(0.05)));
  options->render.near_m = 0.5 * height;
  options->render.far_m = 2.0 * height;
  options->map_from_optical.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  options->map_from_optical.translation() = Eigen::Vector3d(top_down_[0], top_down_[1], height);
}

void ViewArguments::placeOnPath(ViewOptions* options) const {
  const bool built_in = path_file_.empty();
  if (built_in && options->world != scene::kRaceTrack)
    throw std::invalid_argument(
        "--path-pose needs --path FILE: only the world race_track has a path of its own");
  const path::Waypoints waypoints = built_in ? scene::raceTrackWaypoints() : path::readWaypoints(path_file_);
  const std::vector<Eigen::Isometry3d> poses = path::posesAlong(waypoints, {});
  const auto index = static_cast<std::size_t>(*path_pose_);
  if (index >= poses.size())
    reject("--path-pose", std::to_string(index),
           "below " + std::to_string(poses.size()) + ", the poses of the path");
  options->map_from_optical = poses[index] * linkFromOptical();
}

void ViewArguments::placeFree(ViewOptions* options) const {
  std::vector<double> pose = pose_.empty() ? std::vector<double>{0.0, 0.0, 1.0} : pose_;
  pose.resize(5, 0.0);
  const Eigen::Vector3d eye(pose[0], pose[1], pose[2]);
  double yaw = pose[3] * kRadPerDeg, pitch = pose[4] * kRadPerDeg;
  if (!look_at_.empty()) {
    const Eigen::Vector3d towards = Eigen::Vector3d(look_at_[0], look_at_[1], look_at_[2]) - eye;
    if (towards.norm() < 1e-6) throw std::invalid_argument("--look-at is where the camera stands");
    yaw = std::atan2(towards.y(), towards.x());
    pitch = std::atan2(towards.z(), towards.head<2>().norm());
  }
  options->map_from_optical.linear() = mapFromLink(yaw, pitch) * linkFromOptical().linear();
  options->map_from_optical.translation() = eye;
}

ViewOptions ViewArguments::options() const {
  if (path_pose_ && !(pose_.empty() && look_at_.empty() && top_down_.empty()))
    throw std::invalid_argument(
        "--path-pose places the camera already; leave out --pose, --look-at and --top-down");
  if (!top_down_.empty() && !(pose_.empty() && look_at_.empty()))
    throw std::invalid_argument("--top-down places the camera already; leave out --pose and --look-at");
  if (!path_pose_ && !path_file_.empty()) throw std::invalid_argument("--path needs --path-pose N");
  ViewOptions options = options_;
  options.render.camera = image::PinholeCamera::fromFieldOfView(width_, height_, Angle::degrees(fov_deg_));
  if (!top_down_.empty()) {
    placeTopDown(&options);
  } else if (path_pose_) {
    placeOnPath(&options);
  } else {
    placeFree(&options);
  }
  render::validate(options.render);
  return options;
}

}  // namespace sunlit::tools
