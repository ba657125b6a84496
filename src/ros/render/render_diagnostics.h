/// What /diagnostics is told of the render node.
#pragma once

#include <ros/node_handle.h>

#include <optional>
#include <string>

#include "ros/activity.h"
#include "ros/render/options.h"
#include "ros/render/run.h"
#include "ros/render/streams.h"
#include "ros/wall_updater.h"
#include "sunlit/studio/studio.h"

namespace sunlit::ros_interface {

/// What there is to tell of once the world is loaded.
struct RenderParts {
  const studio::Studio& studio;
  const Streams& streams;
  const Run& run;
  const RobotPlaces* robot;  ///< null: there is none
};

/// Two kinds of status: the run (what it does or waits for, how far it is, what draws, the cache), and each
/// condition's camera (images a second, exposure, age of the newest). A warning while the run waits for long,
/// several nodes send one sky, or something is refused or has to be guessed, of which the counts stay; an
/// error where it cannot go on.
class RenderDiagnostics {
 public:
  /// `activity` outlives this.
  RenderDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                    const ActivityOutput& activity, const studio::BakeOptions& bake);

  /// From now on of these too, which outlive this.
  void watch(const RenderParts& parts);
  /// Publishes if it is time to.
  void update() { updater_.update(); }

 private:
  using Status = WallUpdater::Status;
  void tellRun(Status& status) const;
  void tellProgress(Status& status) const;
  void tellCache(Status& status) const;

  const ActivityOutput& activity_;
  std::optional<light::BakeCache> cache_;  // nothing: no bake is wanted
  std::optional<RenderParts> parts_;
  WallUpdater updater_;
};

}  // namespace sunlit::ros_interface
