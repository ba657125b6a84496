/// Command line options that say what is looked at, from where and how; shared by the tools that take
/// pictures.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "sunlit/path/path.h"
#include "sunlit/sky/weather.h"
#include "sunlit/studio/command_line.h"
#include "sunlit/studio/studio.h"
#include "tools/camera_arguments.h"
#include "tools/sensor_arguments.h"

namespace sunlit::tools {

struct ViewOptions {
  studio::StudioOptions studio;
  /// x forward, z up; but of --top-down, whose place the studio knows once its world is there.
  Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();
  Motion motion;  ///< of the camera

  /// Where the camera stands in the world of `of_this`, which is made of `studio`.
  Eigen::Isometry3d placeIn(const studio::Studio& of_this) const {
    return of_this.mapFromTopDown().value_or(map_from_camera);
  }
};

/// How a camera drives.
struct Drive {
  double speed_m_s = 0.0;
  double turning_deg_s = 0.0;
};

/// A point that a camera is turned towards.
struct LookAt {
  double x = 0.0, y = 0.0, z = 0.0;
};

inline std::vector<Field> fieldsOf(LookAt& point) {
  return {{"x", &point.x, "m", kPoseRange_m, ""},
          {"y", &point.y, "m", kPoseRange_m, ""},
          {"z", &point.z, "m", kPoseRange_m, ""}};
}

/// Collects words until the camera can be placed.
class ViewArguments {
 public:
  /// Adds its options to `line`, which reads into this object.
  explicit ViewArguments(studio::CommandLine* line);
  ViewArguments(const ViewArguments&) = delete;
  ViewArguments& operator=(const ViewArguments&) = delete;

  /// What the line has read, to be looked at in this weather. Throws std::invalid_argument for words that do
  /// not go together; what path::readWaypoints() throws.
  ViewOptions options(const sky::Weather& weather) const;

 private:
  void addPlaces();
  void addDrive();
  /// Throws for an option that another one makes meaningless.
  void requireThatAllCount(bool rains) const;
  void requireThatMotionShows(bool rains) const;
  void placeOnPath(ViewOptions* options) const;
  void placeFree(ViewOptions* options) const;

  studio::CommandLine* line_;
  ViewOptions options_;
  TypedPose pose_;
  bool turned_ = false;  ///< by the yaw of `pose_`
  LookAt look_at_;
  studio::TopDown top_down_;
  int path_pose_ = 0;
  std::string path_file_;
  path::PathOptions sampling_;
  Drive drive_;
  CameraWords camera_;
  SensorWords sensor_;
};

}  // namespace sunlit::tools
