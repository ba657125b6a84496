#include "tools/view_arguments.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sunlit/scene/load.h"
#include "tools/path_arguments.h"
#include "tools/world_arguments.h"

namespace sunlit::tools {

ViewArguments::ViewArguments(studio::CommandLine* line) : line_(line) {
  addPlaces();
  addCamera(line_, &camera_);
  addSensor(line_, &sensor_);
  addShutter(line_, &sensor_);
  addDrive();
  addWorld(line_, &options_.studio.world);
  addBounced(line_, &options_.studio.bake);
  addLamps(line_, &options_.studio.lamps);
}

void ViewArguments::addPlaces() {
  line_->group("Where the camera stands");
  line_->add("--pose X,Y,Z[,YAW[,PITCH]]", "the camera in map", fieldsOf(pose_))
      .then([this](const std::string&, const std::string& value) {
        turned_ = std::count(value.begin(), value.end(), ',') > 2;
      });
  line_
      ->add("--look-at X,Y,Z", "turns the camera of --pose towards a point instead of by yaw and pitch",
            fieldsOf(look_at_))
      .withoutDefault();
  line_
      ->add("--path-pose N", {"path_pose", &path_pose_, "", Range::atLeast(0),
                              "pose N along the path, sampled every 1 m, --height above it, instead of "
                              "--pose"})
      .withoutDefault();
  line_->add("--path FILE", {"path", &path_file_, "", {}, pathDoc("that path")});
  line_->add("--height M", fieldOf(fieldsOf(sampling_), "camera_height"));
  line_
      ->add("--top-down X,Y,EXTENT",
            "from straight above, north up, by a field of view of its own instead of --fov, without the air "
            "before it",
            fieldsOf(top_down_))
      .withoutDefault();
}

void ViewArguments::addDrive() {
  line_->add("--speed M/S", {"speed", &drive_.speed_m_s, "m/s", {-1000, 1000}, "of the camera, forward"});
  line_->add("--turning DEG/S",
             {"turning", &drive_.turning_deg_s, "deg/s", {-3600, 3600}, "of the camera, to the left"});
}

void ViewArguments::placeOnPath(ViewOptions* options) const {
  studio::requireWorld(options->studio.world);
  if (path_file_.empty() && options->studio.world.name != scene::kRaceTrack)
    throw std::invalid_argument(
        "--path-pose needs --path FILE: only the world race_track has a path of its own");
  const std::vector<Eigen::Isometry3d> poses = path::posesAlong(waypointsOf(path_file_), sampling_);
  const auto index = static_cast<std::size_t>(path_pose_);
  if (index >= poses.size())
    refuse("--path-pose", std::to_string(index),
           "below " + std::to_string(poses.size()) + ", the poses of the path");
  options->map_from_camera = poses[index];
}

void ViewArguments::placeFree(ViewOptions* options) const {
  Eigen::Isometry3d map_from_camera = mapFromCamera(pose_);
  if (line_->has("--look-at")) {
    const Eigen::Vector3d eye = map_from_camera.translation();
    const Eigen::Vector3d towards = Eigen::Vector3d(look_at_.x, look_at_.y, look_at_.z) - eye;
    if (towards.norm() < 1e-6) throw std::invalid_argument("--look-at is where the camera stands");
    map_from_camera = mapFromCamera(eye, std::atan2(towards.y(), towards.x()),
                                    std::atan2(towards.z(), towards.head<2>().norm()));
  }
  options->map_from_camera = map_from_camera;
}

void ViewArguments::requireThatMotionShows(bool rains) const {
  const image::ShutterOptions& shutter = sensor_.chain.shutter;
  const bool moves = drive_.speed_m_s != 0.0 || drive_.turning_deg_s != 0.0;
  // To a camera that stands, only drops move.
  const bool streaks = rains && shutter.line_delay_us == 0.0;
  if (!shutter.none() && !moves && !streaks)
    throw std::invalid_argument(
        "--line-delay and --exposure-time are of a camera that moves; give --speed or --turning (or "
        "--exposure-time with --rain, for its streaks)");
  if (moves && shutter.none() && !rains)
    throw std::invalid_argument(
        "--speed and --turning show in a picture that takes time, and in streaks of rain; give --line-delay "
        "or --exposure-time, or --rain");
}

void ViewArguments::requireThatAllCount(bool rains) const {
  const bool has_pose = line_->has("--pose");
  const bool has_look_at = line_->has("--look-at");
  const bool has_top_down = line_->has("--top-down");
  const char* what = nullptr;
  if (line_->has("--path-pose") && (has_pose || has_look_at || has_top_down)) {
    what = "--path-pose places the camera already; leave out --pose, --look-at and --top-down";
  } else if (has_top_down && (has_pose || has_look_at)) {
    what = "--top-down places the camera already; leave out --pose and --look-at";
  } else if (has_top_down && line_->has("--calibration")) {
    what = "--top-down has a camera of its own; leave out --calibration";
  } else if (has_top_down && line_->has("--fov")) {
    what = "--top-down has its own field of view, by its EXTENT; leave out --fov";
  } else if (has_look_at && turned_) {
    what = "--look-at turns the camera already; leave YAW and PITCH out of --pose";
  }
  if (what != nullptr) throw std::invalid_argument(what);
  for (const char* of_path : {"--path", "--height"}) line_->requireWith(of_path, {"--path-pose"});
  requireThatMotionShows(rains);
  sensor_.requireSense(*line_);
  camera_.requireSense(options_.studio.bake);
}

ViewOptions ViewArguments::options(const sky::Weather& weather) const {
  requireThatAllCount(weather.rain_mm_per_h > 0.0);
  ViewOptions options = options_;
  options.studio.render = camera_.options();
  sensor_.putInto(&options.studio);
  if (line_->has("--top-down")) {
    options.studio.top_down = top_down_;
    options.map_from_camera.linear() = studio::topDownAxes();
  } else if (line_->has("--path-pose")) {
    placeOnPath(&options);
  } else {
    placeFree(&options);
  }
  render::validate(options.studio.render);
  const Eigen::Matrix3d& axes = options.map_from_camera.linear();
  options.motion = {drive_.speed_m_s * axes.col(0), drive_.turning_deg_s * kRadPerDeg * axes.col(2)};
  return options;
}

}  // namespace sunlit::tools
