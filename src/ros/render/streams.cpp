#include "ros/render/streams.h"

#include <ros/names.h>

#include <future>
#include <stdexcept>

namespace sunlit::ros_interface {

namespace {

std::string sunTopic(const std::string& sun_namespace, const std::string& condition) {
  return ros::names::append(ros::names::append(sun_namespace, condition), "sun");
}

}  // namespace

Streams::Streams(const std::vector<Condition>& conditions, const StreamOptions& options, Studio& studio)
    : studio_(studio),
      wanted_(options.wanted_subscribers),
      pose_output_(ros::NodeHandle(), ros::NodeHandle("~"), options.pose) {
  for (const Condition& condition : conditions) {
    // A sun namespace of its own stands for the node's; the condition's name follows in either.
    const bool own = options.sun_namespace.empty();
    const ros::NodeHandle sun_node = own ? condition.node() : ros::NodeHandle();
    const std::string sun_topic = own ? "sun" : sunTopic(options.sun_namespace, condition.name);
    streams_.push_back(std::unique_ptr<Stream>(
        new Stream{condition.name, SunInput(sun_node, sun_topic, studio.atmosphere()),
                   ConditionOutput(condition.node(), studio.camera(), options.pose.queue_size)}));
  }
}

void Streams::take(const Shot& shot, const std::optional<Eigen::Isometry3d>& next_map_from_camera) {
  studio_.look(shot.map_from_camera);
  std::future<void> exposed = std::async(std::launch::async, [&] { expose(shot); });
  if (next_map_from_camera) studio_.lookAhead(*next_map_from_camera);
  exposed.get();
}

void Streams::expose(const Shot& shot) {
  Stopwatch& stopwatch = studio_.stopwatch();
  const image::DepthImage depth = studio_.depth();
  stopwatch.measure("transport", "pose",
                    [&] { pose_output_.publish(shot.map_from_camera, depth, shot.stamp); });
  for (const auto& stream : streams_) {
    const sky::Daylight& daylight = stopwatch.measure(
        "daylight", stream->name, [&]() -> const sky::Daylight& { return stream->sun.daylight(); });
    Developed developed = studio_.photograph(daylight, stream->name);
    const Photograph photograph{shot.pose_index, shot.stamp, developed.ev100, std::move(developed.picture)};
    stopwatch.measure("transport", stream->name, [&] { stream->output.publish(photograph, daylight); });
  }
}

Streams::Stream& Streams::find(const std::string& condition) {
  std::string names;
  for (const auto& stream : streams_) {
    if (stream->name == condition || (condition.empty() && streams_.size() == 1)) return *stream;
    names += (names.empty() ? "" : ", ") + stream->name;
  }
  throw std::invalid_argument("condition is \"" + condition + "\", but must be one of " + names);
}

Photograph Streams::view(const Shot& shot, const std::string& condition) {
  Stream& stream = find(condition);
  if (!stream.sun.ready()) {
    throw std::invalid_argument("condition \"" + condition + "\" has no sun yet: nothing came on " +
                                stream.sun.topic());
  }
  studio_.look(shot.map_from_camera);
  Developed developed = studio_.photograph(stream.sun.daylight(), stream.name);
  return {shot.pose_index, shot.stamp, developed.ev100, std::move(developed.picture)};
}

std::string Streams::waitsForSun() const {
  for (const auto& stream : streams_) {
    if (!stream->sun.ready()) return "a sun on " + stream->sun.topic();
  }
  return std::string();
}

std::string Streams::waitsForSubscribers() const {
  for (const auto& stream : streams_) {
    const std::string topic = stream->output.lonelyTopic(wanted_);
    if (!topic.empty()) return "subscribers of " + topic;
  }
  const std::string topic = pose_output_.lonelyTopic(wanted_);
  return topic.empty() ? topic : "subscribers of " + topic;
}

}  // namespace sunlit::ros_interface
