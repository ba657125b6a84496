/// The render node: a camera on its way through the scene, under any number of suns at once.
#pragma once

#include <ros/node_handle.h>
#include <std_srvs/Trigger.h>

#include <chrono>
#include <exception>
#include <memory>
#include <optional>
#include <vector>

#include "ros/activity.h"
#include "ros/render/clock_source.h"
#include "ros/render/options.h"
#include "ros/render/path_source.h"
#include "ros/render/render_diagnostics.h"
#include "ros/render/run.h"
#include "ros/render/run_files.h"
#include "ros/render/run_log.h"
#include "ros/render/streams.h"
#include "sunlit/RenderView.h"
#include "sunlit/ros/conditions.h"
#include "sunlit/scene/world_site.h"
#include "sunlit/studio/sky.h"
#include "sunlit/studio/studio.h"

namespace sunlit::ros_interface {

/// What ends work that takes its time where ROS shuts down.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted while the world was loaded"; }
};

/// Ends a run into a folder for which nothing is left to render, before a bake that nobody would see.
class NothingLeft : public std::exception {
 public:
  const char* what() const noexcept override { return "nothing is left to render"; }
};

/// ROS callbacks have their turn between two frames, on the thread that renders: what they change never
/// changes within a frame.
class RenderNode {
 public:
  /// Loads and bakes, which takes its time; throws Interrupted where ROS shuts down meanwhile, and
  /// NothingLeft once the folder of a run that is to end when it is done was found to be of this world.
  RenderNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
             const RenderNodeOptions& options, const RenderConditions& conditions);

  /// Until ROS shuts down, or all is rendered and the options say to end then. The exit status.
  int run();

 private:
  bool onStart(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool isOver(std_srvs::Trigger::Response* response) const;
  bool onPause(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool onView(RenderView::Request& request, RenderView::Response& response);
  /// Of work that takes its time: to the log, and as activity. Throws Interrupted from there.
  studio::Reports reports();
  Step step();
  /// Tells people and topics what came of it.
  void report(Step step);
  void keepTiming();
  /// Refuses to go on with what was made from something else before that takes any time.
  void onLoaded(const light::World& world, const std::string& world_print);
  /// What all is made from, compared with the run that this one goes on with, or written.
  void keepInputs();
  /// Before the first pose, once all readers were heard: an evaluator that refuses its folder never is, and
  /// what the folder holds must then stay as it is.
  void beginFolder();
  /// Warns where the sun is of another site than the world names. With the first picture, when it is known.
  void checkSite();
  void drawMap();
  void finish();
  void reportLosses() const;

  ros::NodeHandle node_;
  ros::NodeHandle private_node_;
  RenderNodeOptions options_;
  ActivityOutput activity_;
  RenderDiagnostics diagnostics_;
  // Before the scene: an unwritable folder, a second clock or a bad waypoint should not cost its loading. And
  // a clock is waited for by all others.
  std::unique_ptr<RunFiles> files_;
  std::unique_ptr<ClockSource> clock_;       // where this node is the time of all
  std::optional<scene::Robot> robot_model_;  // where the options name one
  std::unique_ptr<PathSource> path_;         // not where a TF frame is followed
  std::unique_ptr<RobotPlaces> robot_;       // where there is one
  std::string world_print_;                  // light::fingerprint() of the world, once it is loaded
  std::optional<scene::WorldSite> site_;     // that the world names, until it is compared with the sun's
  bool inputs_kept_ = false;
  studio::Sky sky_;
  studio::Studio studio_;
  Streams streams_;
  PathRun* path_run_ = nullptr;  // run_ where it follows a path
  std::unique_ptr<Run> run_;
  PoseLog pose_log_;
  WaitLog wait_log_;
  bool paused_;
  std::optional<std::chrono::steady_clock::time_point> timing_kept_;  // when it was written last
  bool map_due_ = false;
  bool has_begun_ = false;  // and may write into its folder
  bool finished_ = false;   // all is rendered
  std::vector<ros::ServiceServer> services_;
};

}  // namespace sunlit::ros_interface
