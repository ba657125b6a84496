/// What the render node can be told; config/render.yaml is its manual.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "ros/render/camera_frames.h"
#include "ros/render/robot_options.h"
#include "ros/render/subscribers.h"
#include "sunlit/image/calibration.h"
#include "sunlit/image/exposure.h"
#include "sunlit/image/lens_blur.h"
#include "sunlit/image/mosaic.h"
#include "sunlit/image/sensor_noise.h"
#include "sunlit/image/stereo.h"
#include "sunlit/image/veiling_glare.h"
#include "sunlit/image/vignetting.h"
#include "sunlit/path/path.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/render/renderer.h"
#include "sunlit/ros/conditions.h"
#include "sunlit/ros/parameter_reader.h"
#include "sunlit/sky/weather.h"
#include "sunlit/studio/sky.h"
#include "sunlit/studio/studio.h"

namespace sunlit::ros_interface {

/// Where the waypoints come from and which poses along them are rendered.
struct PathSourceOptions {
  std::string file;  ///< CSV or TUM; empty: not from a file
  std::string
      topic;  ///< nav_msgs/Path; empty: not from a topic. Neither: the built-in path of the built-in world
  path::PathOptions sampling;  ///< spacing and camera height
  path::PoseSelection selection;
  std::optional<double>
      speed_m_s;  ///< by which pictures are skewed and smeared; nothing: from stamp to stamp
};

struct CameraOptions {
  int width = 640;
  int height = 480;
  Angle horizontal_fov = Angle::degrees(60.0);
  std::string calibration_file;                   ///< empty: size and field of view say what the camera is
  std::optional<image::Calibration> calibration;  ///< what was read there
  std::string right_calibration_file;             ///< of a stereo camera's right one; empty: see baseline_m
  double baseline_m = 0.0;                        ///< above 0: to a right camera like this one
  std::optional<image::RightCamera> right;        ///< what these two make
  int supersampling = 2;
  render::RasterizerKind rasterizer = render::defaultRasterizer();
  bool follow_tf = false;
  std::string follow_frame = "base_link";
};

/// How many subscribers each topic must have before the first image leaves.
struct WantedSubscribers {
  int images = 0;  ///< of camera/image_raw and camera/capture
  int poses = 0;   ///< of camera/pose
  int truth = 0;   ///< of camera/camera_info and camera/depth/image_raw
  int others = 0;  ///< of these, camera/depth/camera_info and TF
  int left = 0;    ///< of camera/left/image_raw and camera/left/camera_info, where there is a right camera
  int right = 0;   ///< of camera/right/image_raw and camera/right/camera_info, likewise
  std::vector<std::string> of;  ///< which nodes are counted; empty: whoever
  /// Of camera/camera_info and camera/depth/image_raw.
  int ofTruth() const { return std::max(truth, others); }
  Audience audience(int size) const { return {size, of}; }
};

/// When a pose may be rendered.
struct PacingOptions {
  double frame_rate = 10.0;             ///< stamps of consecutive poses differ by its inverse
  std::optional<double> start_stamp_s;  ///< stamp of pose 0, s; nothing: ROS time when it can be taken
  int max_ahead = 8;                    ///< poses ahead of the slowest of wait_for
  bool looks_ahead = true;              ///< draws the next pose while this one is lit, with memory for both
  std::vector<std::string> wait_for;    ///< progress topics (std_msgs/UInt32): poses done since the first
  bool counts_skipped = false;          ///< whether those are all of the path; else those of path/stride
  WantedSubscribers subscribers;        ///< start only when each topic has as many
  int resume_at = 0;                    ///< poses since the first that an earlier run has done
  bool autostart = true;                ///< false: wait for ~start
  bool exit_when_done = false;          ///< end with status 0 once all poses have reached their readers
  bool publish_clock = false;  ///< this node is the time of all: /clock stands at the pose to be rendered
  bool exact_sky = false;      ///< only skies of exactly a pose's stamp; true with publish_clock
};

struct RenderNodeOptions {
  studio::WorldOptions world;
  PathSourceOptions path;
  CameraOptions camera;
  RobotOptions robot;
  studio::ChainOptions chain;  ///< of every condition that does not say otherwise
  light::LampOptions lamps;
  studio::SkyOptions sky;
  sky::Weather weather;          ///< of every condition that does not say otherwise, too
  scene::SurfaceState surfaces;  ///< likewise
  studio::BakeOptions bake;
  int final_gather = 0;  ///< render::RenderOptions::final_gather
  PacingOptions pacing;
  bool night = true;          ///< moon and stars too: waits for c/moon and c/celestial
  std::string sun_namespace;  ///< of the topics c/sun, c/moon and c/celestial; empty: the node's own
  std::string output_dir;     ///< map and timing are written there; empty: nowhere
  bool publish_tf = true;
  bool compressed = false;  ///< pictures in PNG
  CameraFrames frames;
  bool warns_of_inputs = true;       ///< else another renderer of the same does
  int threads = 0;                   ///< 0: as many as there are cores
  double diagnostic_period_s = 1.0;  ///< which the WallUpdater reads by itself

  studio::StudioOptions studioOptions() const;
  /// As it stands in camera_info.
  image::Calibration calibration() const;
  /// The camera's is the one that is followed, where one is.
  CameraFrames cameraFrames() const;
};

/// One row for each parameter but ~conditions.
std::vector<Field> fieldsOf(RenderNodeOptions& options);

/// A condition of the renderer: its sun is its topics' business, its weather the renderer's, what that leaves
/// on surfaces, and what pictures are taken with.
struct RenderCondition {
  Condition named;
  sky::Weather weather;
  std::size_t state = 0;  ///< of the surfaces, number in RenderConditions::states
};
struct RenderConditions {
  std::vector<RenderCondition> all;
  std::vector<scene::SurfaceState> states;   ///< that they need, each once
  std::vector<studio::ChainOptions> chains;  ///< one a condition, in their order
};

/// ~conditions, whose weathers and chains may differ. Throws std::invalid_argument with name, value and what
/// is allowed; warns of weather that a site under `sky` must be high to have, where its height is not known.
RenderConditions readRenderConditions(const ParameterReader& parameters, const studio::SkyOptions& sky);

/// All parameters but ~conditions. Throws std::invalid_argument with name, value and what is allowed.
RenderNodeOptions readRenderNodeOptions(const ParameterReader& parameters);

}  // namespace sunlit::ros_interface
