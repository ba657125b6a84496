/// The two ways to move the camera: along a path, and after a TF frame.
#pragma once

#include <ros/node_handle.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "ros/render/clock_source.h"
#include "ros/render/optical_frame.h"
#include "ros/render/pacer.h"
#include "ros/render/path_source.h"
#include "ros/render/robot_places.h"
#include "ros/render/streams.h"
#include "ros/render/tf_lookup.h"
#include "ros/render/wait.h"

namespace sunlit::ros_interface {

/// What became of one step.
enum class Step {
  kTook,     ///< one pose was rendered
  kMetered,  ///< one was metered that nobody gets; for what, see Run::waitsFor()
  kWaits,    ///< see Run::waitsFor()
  kDone,     ///< there is nothing left to render
};

/// How far a run is, in poses that it renders.
struct RunProgress {
  int done = 0;              ///< with those of an earlier run that it goes on with
  std::optional<int> to_do;  ///< nothing: it has no end, or its path is not known yet
  std::optional<int> ahead;  ///< of the slowest reader; nothing: none is waited for
};

/// Renders or meters one pose a step, when it may.
class Run {
 public:
  virtual ~Run() = default;
  /// Makes known what is known before the start. Call it before begin() and each step, also while paused.
  virtual void announce() {}
  /// Whether all is there that a run needs before its first pose, its readers too; else see waitsFor(). Call
  /// it until it says so, and step() only from then on.
  virtual bool begin() = 0;
  virtual Step step() = 0;
  /// Why the latest step rendered nothing; empty where that needs no words.
  virtual Wait waitsFor() const = 0;
  /// Whether what it waits for will never come.
  virtual bool isStuck() const { return false; }
  virtual RunProgress progress() const = 0;
  /// Of the robot at the latest pose, or the first one, as far as known; empty: there is none.
  virtual render::BodyPlaces mapFromLinks() = 0;
};

/// What is heard on TF.
struct TfInput {
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener{buffer};
};

class PathRun : public Run {
 public:
  /// All outlive the run. With a clock, it is set to the stamp of each pose just before that is rendered;
  /// without one and without readers to wait for, no pose is rendered before its stamp.
  struct Parts {
    const PathSource& path;
    Streams& streams;
    RobotPlaces* robot;  ///< may be null
    ClockSource* clock;  ///< may be null
  };
  PathRun(ros::NodeHandle node, const PacingOptions& options, const Parts& parts);
  void announce() override;
  bool begin() override;
  Step step() override;
  Wait waitsFor() const override { return waits_for_; }
  bool isStuck() const override { return next_ && (streams_.missedSky(next_->stamp) || waits_set_back_); }
  RunProgress progress() const override;
  render::BodyPlaces mapFromLinks() override;

  /// Poses from the first of the run up to the one to be rendered next, and all of them.
  int position() const { return std::min(position_, positions()); }
  int positions() const { return path_.end() - path_.first(); }

 private:
  std::string missing();
  void setStart(const ros::Time& start);
  ros::Time startOfNow() const;
  /// Sees a clock that jumps back.
  void heedClock();
  /// After such a jump, where the path begins by the clock.
  Step beginAnew();
  /// Whether the time of a pose has come.
  bool isTime(const ros::Time& stamp);
  Shot shotAt(int position, const RobotPlaces::Joints& joints) const;
  /// As TF has them now, where joints go by it; else at rest.
  RobotPlaces::Joints joints() const;
  /// A step at the next pose, which no reader holds up.
  Step render();
  /// Lets exposures that lag see the next pose that they miss before `shot`; false where they miss none.
  bool metersBefore(const Shot& shot);
  /// The poses before `position` as readers count them.
  int counted(int position) const;

  PacingOptions options_;
  const PathSource& path_;
  Streams& streams_;
  RobotPlaces* robot_;
  std::unique_ptr<TfInput> tf_;  ///< where joints move
  ClockSource* clock_;
  Pacer pacer_;
  ros::Time start_;              ///< stamp of pose 0; zero until it is known
  ros::Time seen_;               ///< by the clock, last
  ros::Time set_back_from_;      ///< by the clock, and no pose was taken since; zero: it was not
  bool waits_set_back_ = false;  ///< for what was to come before the clock was set back
  bool announced_ = false;       ///< where this run begins
  int position_ = 0;
  std::optional<Shot> next_;           ///< drawn ahead, if options_ wants it; joints by TF still rest
  render::BodyPlaces map_from_links_;  ///< of the latest shot
  TimeWait time_wait_;
  Wait waits_for_;
};

struct FollowOptions {
  CameraFrames frames;  ///< the camera's is followed
  double frame_rate = 10.0;
  bool publish_tf = true;  ///< the optical frames, where nobody else does
  std::optional<image::RightCamera> right = {};
  bool shows_motion = false;  ///< whether it matters to pictures how the camera moves
};

class FollowRun : public Run {
 public:
  /// `streams` and `robot`, which may be null, outlive this.
  FollowRun(const FollowOptions& options, Streams& streams, RobotPlaces* robot);
  bool begin() override;
  Step step() override;
  Wait waitsFor() const override { return waits_for_; }
  RunProgress progress() const override { return {taken_, std::nullopt, std::nullopt}; }
  render::BodyPlaces mapFromLinks() override { return map_from_links_; }

 private:
  /// The next moment of the frame and the robot; none where it has to be waited for.
  std::optional<Shot> nextShot();
  /// By TF just before.
  Motion motionOf(const FoundTransform& found);
  /// Says once that skies come too seldom for the frame rate.
  void watchSkies(const ros::Time& stamp);

  CameraFrames frames_;
  ros::Duration period_;
  bool shows_motion_;
  std::optional<OpticalFrames> optical_;
  Streams& streams_;
  RobotPlaces* robot_;
  std::chrono::duration<double> hold_;
  TfInput tf_;
  // The frame's newest moment, kept while the robot's links of that moment are on their way: where links are
  // sent later than the frame, those of its newest moment would never be there.
  using Clock = std::chrono::steady_clock;
  std::optional<FoundTransform> held_;
  Clock::time_point held_since_;
  std::optional<Shot> shot_;  ///< that waits for its sky
  ros::Time seen_;            ///< by the clock, last
  ros::Time next_;
  ros::Time latest_;
  int taken_ = 0;
  int sparse_ = 0;                     ///< shots in a row that were between skies too far apart
  render::BodyPlaces map_from_links_;  ///< of the latest shot
  TimeWait time_wait_;
  Wait waits_for_;
};

}  // namespace sunlit::ros_interface
