#include "ros/render/render_node.h"

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/init.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "ros/conversions/geometry.h"
#include "ros/conversions/images.h"
#include "ros/render/input_log.h"
#include "sunlit/ros/delivery.h"
#include "sunlit/studio/other_site.h"

namespace sunlit::ros_interface {

namespace {

StreamOptions streamOptions(const RenderNodeOptions& options) {
  StreamOptions streams;
  streams.output.camera = options.calibration();
  streams.output.right = options.camera.right;
  streams.output.frames = options.cameraFrames();
  streams.output.compressed = options.compressed;
  streams.output.publish_tf = options.publish_tf;
  streams.output.follows_tf = options.camera.follow_tf;
  // A reader that is paced can never be further behind than this, so roscpp has no reason to drop a message.
  streams.output.queue_size = static_cast<std::uint32_t>(options.pacing.max_ahead + 2);
  streams.night = options.night;
  streams.sky = options.pacing.exact_sky ? SkyRule::kExact : SkyRule::kAround;
  streams.sun_namespace = options.sun_namespace;
  streams.wanted_subscribers = options.pacing.subscribers;
  return streams;
}

studio::StudioOptions studioOptions(const RenderNodeOptions& options, const RenderConditions& conditions) {
  studio::StudioOptions studio = options.studioOptions();
  studio.surfaces = conditions.states;
  studio.chains = conditions.chains;
  return studio;
}

/// Topics that are advertised from the shutdown on are none, and to publish on them ends the process.
void throwIfInterrupted() {
  if (ros::isShuttingDown()) throw Interrupted();
}

/// Where this node is the time of all, there is no other to begin at than the wall clock's.
RenderNodeOptions withStart(RenderNodeOptions options) {
  PacingOptions& pacing = options.pacing;
  if (pacing.publish_clock && !pacing.start_stamp_s) pacing.start_stamp_s = ros::WallTime::now().toSec();
  return options;
}

/// Until the first pose is rendered, wherever on the path that is, time stands one pose before the path's
/// begin, or between 0 and that.
std::unique_ptr<ClockSource> clockSource(const ros::NodeHandle& node, const PacingOptions& pacing) {
  if (!pacing.publish_clock) return nullptr;
  const double start_s = *pacing.start_stamp_s;
  const double before_s = start_s - 1.0 / pacing.frame_rate;
  return std::make_unique<ClockSource>(node, ros::Time(before_s > 0.0 ? before_s : 0.5 * start_s));
}

/// The robot goes as path/yaw says, and its camera may be turned on it.
PathSourceOptions pathOfCamera(const RenderNodeOptions& options, const std::optional<scene::Robot>& robot) {
  PathSourceOptions path = options.path;
  const Angle turn = robot ? cameraYaw(*robot, options.robot, options.cameraFrames()) : Angle();
  if (turn != Angle())
    path.sampling.yaw = Angle::radians(std::remainder(path.sampling.yaw.rad() + turn.rad(), 2.0 * kPi));
  return path;
}

std::unique_ptr<RobotPlaces> placesOf(const std::optional<scene::Robot>& robot,
                                      const RenderNodeOptions& options) {
  if (!robot) return nullptr;
  std::optional<double> camera_height_m;
  if (!options.camera.follow_tf) camera_height_m = options.path.sampling.height_m;
  return std::make_unique<RobotPlaces>(*robot, options.robot, options.cameraFrames(), camera_height_m);
}

}  // namespace

RenderNode::RenderNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                       const RenderNodeOptions& options, const RenderConditions& conditions)
    : node_(node),
      private_node_(private_node),
      options_(withStart(options)),
      activity_(private_node),
      diagnostics_(node, private_node, activity_, options.bake),
      files_(options.output_dir.empty()
                 ? nullptr
                 : std::make_unique<RunFiles>(options.output_dir, options.pacing.resume_at > 0)),
      clock_(clockSource(node, options_.pacing)),
      robot_model_(loadRobot(options.robot, options.world.searchPath())),
      path_(options.camera.follow_tf ? nullptr
                                     : std::make_unique<PathSource>(node, pathOfCamera(options, robot_model_),
                                                                    options.frames.map)),
      robot_(placesOf(robot_model_, options)),
      sky_(options.sky, reports()),
      studio_(studioOptions(options, conditions), robot_model_, reports()),
      streams_(conditions, streamOptions(options), studio_, sky_),
      paused_(!options.pacing.autostart) {
  sky_.over(studio_.worlds());
  if (path_) {
    auto run = std::make_unique<PathRun>(node_, options_.pacing,
                                         PathRun::Parts{*path_, streams_, robot_.get(), clock_.get()});
    path_run_ = run.get();
    run_ = std::move(run);
  } else {
    FollowOptions follow{options_.cameraFrames(), options_.pacing.frame_rate, options_.publish_tf,
                         options_.camera.right};
    for (std::size_t i = 0; i < conditions.all.size(); ++i)
      follow.shows_motion |=
          !conditions.chains[i].shutter.none() || conditions.all[i].weather.rain_mm_per_h > 0.0;
    run_ = std::make_unique<FollowRun>(follow, streams_, robot_.get());
  }
  diagnostics_.watch({studio_, streams_, *run_, robot_.get()});
  services_ = {private_node_.advertiseService("start", &RenderNode::onStart, this),
               private_node_.advertiseService("pause", &RenderNode::onPause, this),
               private_node_.advertiseService("render_view", &RenderNode::onView, this)};
  throwIfInterrupted();
}

studio::Reports RenderNode::reports() {
  activity_.say("loading", options_.world.name);
  diagnostics_.update();
  studio::Reports reports = loggedReports();
  reports.check = throwIfInterrupted;
  reports.baking = [this, log = reports.baking](double share, double seconds_left) {
    throwIfInterrupted();
    if (log) log(share, seconds_left);
    activity_.say("baking", "", {share, seconds_left});
    diagnostics_.update();
  };
  reports.loaded = [this](const light::World& world, const std::string& print) { onLoaded(world, print); };
  return reports;
}

void RenderNode::onLoaded(const light::World& world, const std::string& world_print) {
  world_print_ = world_print;
  site_ = scene::siteOf(options_.world.name, options_.world.searchPath());
  if (path_ && path_->ready())
    path_->warnIfFarFrom(studio::boundsOf(world), options_.studioOptions().render.far_m);
  if (!files_ || !files_->goesOn() || !path_ || !path_->ready()) return;
  keepInputs();
  const PacingOptions& pacing = options_.pacing;
  if (pacing.exit_when_done && pacing.resume_at >= path_->end() - path_->first()) throw NothingLeft();
}

int RenderNode::run() {
  ros::CallbackQueue& callbacks = *ros::getGlobalCallbackQueue();
  const ros::WallDuration patience(0.01);
  Step latest = Step::kWaits;
  while (ros::ok()) {
    // After a frame only what is there already; else wait a moment for something to come.
    const bool is_busy = latest == Step::kTook || latest == Step::kMetered;
    callbacks.callAvailable(is_busy ? ros::WallDuration() : patience);
    latest = step();
    diagnostics_.update();
    if (latest == Step::kDone && !finished_) finish();
    if (finished_ && options_.pacing.exit_when_done) break;
  }
  if (clock_) clock_->stop();  // what is published all the time is never delivered
  deliverTheLast();
  if (files_ && has_begun_) files_->writeTiming(studio_.stopwatch());
  reportLosses();
  return 0;
}

void RenderNode::reportLosses() const {
  // Not through the log, which a signal has closed already.
  for (const auto& [what, poses] : streams_.faultyPoses())
    if (!areInputsLeftToAnother())
      std::fprintf(stderr, "Poses that %s: %zu of %zu\n", what.c_str(), poses, streams_.poses());
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    const StreamState& state = streams_.state(i);
    if (state.black > 0)
      std::fprintf(stderr, "Pictures%s that are black all over: %zu of %zu\n",
                   (state.condition.empty() ? "" : " of " + state.condition).c_str(), state.black,
                   state.images);
  }
  if (robot_ && !robot_->missingLinks().empty()) std::fprintf(stderr, "%s\n", robot_->missingLinks().c_str());
}

Step RenderNode::step() {
  if (finished_) return Step::kWaits;
  run_->announce();
  if (paused_) {
    const std::string start = "the service " + private_node_.resolveName("start");
    wait_log_.report(start);
    activity_.say("waiting", start);
    return Step::kWaits;
  }
  if (!has_begun_) {
    has_begun_ = run_->begin();
    if (!has_begun_) {
      report(Step::kWaits);
      return Step::kWaits;
    }
    if (files_ && path_) beginFolder();
  }
  const Step step = run_->step();
  report(step);
  return step;
}

void RenderNode::report(Step step) {
  const Wait wait = step == Step::kWaits || step == Step::kMetered ? run_->waitsFor() : Wait();
  if (wait_log_.report(wait)) activity_.say("waiting", wait.words);
  if (wait.empty() && activity_.latest().doing == "waiting") activity_.say("rendering");
  if (step != Step::kTook) return;
  checkSite();
  drawMap();
  keepTiming();
  if (path_run_ == nullptr) return activity_.say("rendering");
  const int position = path_run_->position(), positions = path_run_->positions();
  pose_log_.report(position, positions);
  activity_.say("rendering", "",
                {static_cast<double>(position) / static_cast<double>(positions), pose_log_.secondsLeft()});
}

void RenderNode::keepTiming() {
  // A kill costs the time sheet no more than this; the disk may be slow to make each of them last.
  constexpr std::chrono::seconds kInterval(5);
  const auto now = std::chrono::steady_clock::now();
  if (!files_ || (timing_kept_ && now - *timing_kept_ < kInterval)) return;
  files_->writeTiming(studio_.stopwatch());
  timing_kept_ = now;
}

void RenderNode::keepInputs() {
  const studio::StudioOptions seen = options_.studioOptions();
  files_->keepInputs({world_print_, path_->fingerprint(), cameraPrint(seen.render, seen.right),
                      robot_ ? robot_->print() : std::string()});
  inputs_kept_ = true;
}

void RenderNode::beginFolder() {
  if (!inputs_kept_) keepInputs();
  files_->keepRasterizer(studio_.rasterizer());
  files_->keepGround(sky_.groundAlbedo());
  map_due_ = !files_->hasMap();
}

void RenderNode::checkSite() {
  const std::optional<scene::WorldSite> world = std::exchange(site_, std::nullopt);
  if (world && !streams_.isOver(*world))
    ROS_LOG(inputLevel(), ROSCONSOLE_DEFAULT_NAME, "%s", studio::otherSiteText(*world).c_str());
}

/// While others look at the first picture: it takes seconds in which they would wait for it.
void RenderNode::drawMap() {
  if (!std::exchange(map_due_, false)) return;
  const studio::MapExtent extent = extentOf(*path_);
  studio::SkyBodies noon{{Direction(Azimuth::degrees(160.0), Angle::degrees(55.0)), 1.0}};
  noon.site_elevation_m = streams_.siteElevation();
  const auto draw = [&] { return studio_.mapFromAbove(extent, sky_.daylight(noon)); };
  files_->writeMap(studio_.stopwatch().measure("load", "map", draw), extent);
}

void RenderNode::finish() {
  drawMap();
  finished_ = true;
  activity_.say("done", "", {1.0, 0.0});
  if (files_) files_->writeTiming(studio_.stopwatch());
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  ROS_INFO("All poses are rendered; at its peak this process held %ld MiB", usage.ru_maxrss / 1024);
}

/// Nothing can be started or paused any more.
bool RenderNode::isOver(std_srvs::Trigger::Response* response) const {
  if (!finished_) return false;
  response->success = false;
  response->message = "all poses are rendered: a node that is started anew renders them again";
  return true;
}

bool RenderNode::onStart(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
  if (isOver(&response)) return true;
  response.success = true;
  response.message = paused_ ? "started" : "was running already";
  if (paused_) {
    pose_log_ = PoseLog();  // a pause is no time that poses take
    activity_.say("rendering");
  }
  paused_ = false;
  return true;
}

bool RenderNode::onPause(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
  if (isOver(&response)) return true;
  response.success = true;
  response.message = paused_ ? "was paused already" : "paused";
  paused_ = true;
  return true;
}

bool RenderNode::onView(RenderView::Request& request, RenderView::Response& response) {
  try {
    const Photograph photograph =
        streams_.view({0, ros::Time::now(), fromPose(request.pose), run_->mapFromLinks()}, request.condition);
    const std_msgs::Header header = headerOf(options_.frames.optical, photograph.stamp);
    response.image = *toImageMessage(photograph.picture, header);
    response.camera_info = toCameraInfo(options_.calibration(), header);
    response.success = true;
  } catch (const std::invalid_argument& error) {
    response.success = false;
    response.message = error.what();
  }
  return true;
}

}  // namespace sunlit::ros_interface
