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

namespace {

constexpr const char* kPlaceHelp =
    R"(  --pose X,Y,Z[,YAW[,PITCH]]     camera in map, m and deg; yaw counter-clockwise from east, pitch up is positive
                                 (default 0,0,1,0,0)
  --look-at X,Y,Z                turns the camera of --pose towards this point instead of by yaw and pitch
  --path-pose N                  pose N along the path, sampled every 1 m, 1 m above it, instead of --pose
  --path FILE                    that path: CSV or TUM; without it the path of race_track
  --top-down X,Y,EXTENT          view from straight above, north up: EXTENT m wide about X,Y; has a --fov of its own
)";

constexpr const char* kSensorHelp =
    R"(  --ev auto|NUMBER               exposure value at ISO 100, -16 ... 24 (default auto)
  --compensation STOPS           of --ev auto: brighter (+) or darker (-), -8 ... 8 (default 0)
  --noise SEED                   adds the noise of a sensor, with this seed, 0 ... 2147483647 (default none)
)";

}  // namespace

std::string viewHelp() {
  return std::string(kWorldHelp) + kPlaceHelp + kCameraHelp + kSensorHelp + kBouncedHelp;
}

bool ViewArguments::take(const std::string& key, const std::string& value) {
  return takeWorld(key, value, &options_.world) || takeBounced(key, value, &options_.world) ||
         takeCamera(key, value, &camera_) || takePlace(key, value) || takeSensor(key, value);
}

bool ViewArguments::takePlace(const std::string& key, const std::string& value) {
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
  if (key == "--ev") {
    options_.exposure.mode = value == "auto" ? image::ExposureMode::kAuto : image::ExposureMode::kFixed;
    if (value != "auto") options_.exposure.ev100 = numberWithin(key, value, -16.0, 24.0);
  } else if (key == "--compensation") {
    options_.exposure.compensation_ev = numberWithin(key, value, -8.0, 8.0);
    has_compensation_ = true;
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
  options->render.camera = image::PinholeCamera::fromFieldOfView(camera_.width, camera_.height,
                                                                 Angle::radians(2.0 * std::atan(0.05)));
  options->render.near_m = 0.5 * height;
  options->render.far_m = 2.0 * height;
  options->map_from_optical.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  options->map_from_optical.translation() = Eigen::Vector3d(top_down_[0], top_down_[1], height);
}

void ViewArguments::placeOnPath(ViewOptions* options) const {
  const bool built_in = path_file_.empty();
  if (built_in && options->world.name != scene::kRaceTrack)
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
  Eigen::Isometry3d map_from_camera =
      mapFromCamera(pose_.empty() ? std::vector<double>{0.0, 0.0, 1.0} : pose_);
  if (!look_at_.empty()) {
    const Eigen::Vector3d eye = map_from_camera.translation();
    const Eigen::Vector3d towards = Eigen::Vector3d(look_at_[0], look_at_[1], look_at_[2]) - eye;
    if (towards.norm() < 1e-6) throw std::invalid_argument("--look-at is where the camera stands");
    map_from_camera = mapFromCamera(eye, std::atan2(towards.y(), towards.x()),
                                    std::atan2(towards.z(), towards.head<2>().norm()));
  }
  options->map_from_optical.linear() = map_from_camera.linear() * linkFromOptical().linear();
  options->map_from_optical.translation() = map_from_camera.translation();
}

void ViewArguments::requireThatAllCount() const {
  const char* what = nullptr;
  if (path_pose_ && !(pose_.empty() && look_at_.empty() && top_down_.empty())) {
    what = "--path-pose places the camera already; leave out --pose, --look-at and --top-down";
  } else if (!top_down_.empty() && !(pose_.empty() && look_at_.empty())) {
    what = "--top-down places the camera already; leave out --pose and --look-at";
  } else if (!top_down_.empty() && camera_.fov_deg) {
    what = "--top-down has its own field of view, by its EXTENT; leave out --fov";
  } else if (!look_at_.empty() && pose_.size() > 3) {
    what = "--look-at turns the camera already; leave YAW and PITCH out of --pose";
  } else if (!path_pose_ && !path_file_.empty()) {
    what = "--path needs --path-pose N";
  } else if (has_compensation_ && options_.exposure.mode == image::ExposureMode::kFixed) {
    what = "--compensation needs --ev auto";
  }
  if (what != nullptr) throw std::invalid_argument(what);
  camera_.requireSense(options_.world);
}

ViewOptions ViewArguments::options() const {
  requireThatAllCount();
  ViewOptions options = options_;
  options.render = camera_.options();
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
