#include "ros/render/render_diagnostics.h"

namespace sunlit::ros_interface {

namespace {

using Status = WallUpdater::Status;
using Level = diagnostic_msgs::DiagnosticStatus;

/// Tells of one condition. Rates are own numbers, since a diagnostic_updater::FrequencyStatus counts by ROS
/// time, which may stand still.
class CameraStatus {
 public:
  CameraStatus(const Streams& streams, std::size_t index) : streams_(streams), index_(index) {}

  void operator()(Status& status) {
    const StreamState& state = streams_.state(index_);
    const ros::SteadyTime now = ros::SteadyTime::now();
    const double elapsed_s = (now - told_).toSec();
    const double rate = elapsed_s > 0.0 ? static_cast<double>(state.images - told_images_) / elapsed_s : 0.0;
    told_ = now;
    told_images_ = state.images;
    status.addf("images a second", "%.2f", rate);
    status.add("images", state.images);
    status.add("black images", state.black);
    const std::size_t refused = streams_.refusedSkies(index_);
    status.add("messages of its sky refused", refused);
    const std::string mixed = streams_.mixedSkyTopics(index_);
    status.add("topics of several senders", mixed.empty() ? "none" : mixed);
    if (state.images > 0) {
      status.addf("EV100 of the newest", "%.3f", state.ev100);
      status.addf("age of the newest by ROS time, s", "%.3f", (ros::Time::now() - state.stamp).toSec());
    }
    if (!mixed.empty()) {
      status.summary(Level::WARN, "several nodes send " + mixed);
    } else if (refused > told_refused_ || streams_.isRefusingSkies(index_)) {
      status.summaryf(Level::WARN, "messages of its sky refused: %zu", refused);
    } else if (state.is_black) {
      status.summaryf(Level::WARN, "%zu of %zu images are black all over", state.black, state.images);
    } else {
      status.summaryf(Level::OK, "%zu images", state.images);
    }
    told_refused_ = refused;
  }

 private:
  const Streams& streams_;
  std::size_t index_;
  ros::SteadyTime told_ = ros::SteadyTime::now();
  std::size_t told_images_ = 0;
  std::size_t told_refused_ = 0;
};

}  // namespace

RenderDiagnostics::RenderDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                                     const ActivityOutput& activity, const studio::BakeOptions& bake)
    : activity_(activity), updater_(node, private_node) {
  if (bake.enabled) cache_ = studio::cacheOf(bake);
  updater_.add("run", [this](Status& status) { tellRun(status); });
}

void RenderDiagnostics::watch(const RenderParts& parts) {
  parts_.emplace(parts);
  for (std::size_t index = 0; index < parts.streams.size(); ++index) {
    const std::string& condition = parts.streams.state(index).condition;
    updater_.add(condition.empty() ? "camera" : condition + "/camera", CameraStatus(parts.streams, index));
  }
}

void RenderDiagnostics::tellRun(Status& status) const {
  const Activity& activity = activity_.latest();
  const bool waits = activity.doing == "waiting";
  const std::string resting = parts_ && parts_->robot ? parts_->robot->missingLinks() : std::string();
  if (waits && parts_ && parts_->run.isStuck()) {
    status.summary(Level::ERROR, "cannot go on without " + activity.detail);
  } else if (waits) {
    status.summary(Level::WARN, "waits for " + activity.detail);
  } else {
    const bool lacks_links = parts_ && parts_->robot && parts_->robot->lacksLinks();
    status.summary(lacks_links ? Level::WARN : Level::OK, lacks_links ? resting : activity.doing);
  }
  status.add("activity", activity.doing);
  status.add("waits for", waits ? activity.detail : "nothing");
  if (parts_) {
    tellProgress(status);
    status.add("rasterizer", parts_->studio.rasterizer());
    status.add("robot", parts_->robot == nullptr ? "none" : resting.empty() ? "as known" : resting);
  }
  tellCache(status);
}

void RenderDiagnostics::tellCache(Status& status) const {
  constexpr double kBytesPerMegabyte = 1e6;
  status.add("cache of bakes", cache_ ? cache_->folder : "none");
  if (!cache_) return;
  status.addf("size of the cache", "%.1f of %.1f MB",
              static_cast<double>(cache_->usedBytes()) / kBytesPerMegabyte,
              static_cast<double>(cache_->limit_bytes) / kBytesPerMegabyte);
}

void RenderDiagnostics::tellProgress(Status& status) const {
  const RunProgress progress = parts_->run.progress();
  status.add("poses done", progress.done);
  status.add("poses to do", progress.to_do ? std::to_string(*progress.to_do) : "unknown");
  status.add("poses ahead of the slowest reader",
             progress.ahead ? std::to_string(*progress.ahead) : "none is waited for");
}

}  // namespace sunlit::ros_interface
