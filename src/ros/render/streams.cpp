#include "ros/render/streams.h"

#include <ros/console.h>
#include <ros/names.h>

#include <future>
#include <stdexcept>

#include "sunlit/ros/star_light.h"

namespace sunlit::ros_interface {

namespace {

/// A sun namespace of its own stands for the node's; the condition's name follows in either.
ros::NodeHandle skyNode(const Condition& condition, const StreamOptions& options) {
  return options.sun_namespace.empty() ? condition.node() : ros::NodeHandle();
}

std::string skyPrefix(const Condition& condition, const StreamOptions& options) {
  if (options.sun_namespace.empty()) return std::string();
  return ros::names::append(options.sun_namespace, condition.name) + "/";
}

std::shared_ptr<const std::vector<sky::Star>> starsFor(const StreamOptions& options) {
  if (!options.night) return nullptr;
  const StarLight light = loadStars();
  for (const std::string& warning : light.warnings) ROS_WARN("%s", warning.c_str());
  return light.stars;
}

}  // namespace

Streams::Stream::Stream(const Condition& condition, const StreamOptions& options,
                        const image::PinholeCamera& camera)
    : name(condition.name),
      sky(skyNode(condition, options), skyPrefix(condition, options), options.night),
      output(condition.node(), camera, options.pose.queue_size) {}

Streams::Streams(const std::vector<Condition>& conditions, const StreamOptions& options, Studio& studio)
    : studio_(studio),
      stars_(starsFor(options)),
      wanted_(options.wanted_subscribers),
      pose_output_(ros::NodeHandle(), ros::NodeHandle("~"), options.pose) {
  for (const Condition& condition : conditions)
    streams_.push_back(std::make_unique<Stream>(condition, options, studio.camera()));
}

void Streams::take(const Shot& shot, const std::optional<Shot>& next) {
  studio_.look(shot.map_from_camera, shot.map_from_links);
  std::future<void> exposed = std::async(std::launch::async, [&] { expose(shot); });
  if (next) studio_.lookAhead(next->map_from_camera, next->map_from_links);
  exposed.get();
}

void Streams::expose(const Shot& shot) {
  Stopwatch& stopwatch = studio_.stopwatch();
  const image::DepthImage depth = studio_.depth();
  stopwatch.measure("transport", "pose",
                    [&] { pose_output_.publish(shot.map_from_camera, depth, shot.stamp); });
  for (const auto& stream : streams_) {
    const light::Illumination& light = lightOf(*stream);
    Developed developed = studio_.photograph(light, {shot.pose_index, stream->name});
    const Photograph photograph{shot.pose_index, shot.stamp, developed.ev100, std::move(developed.picture)};
    stopwatch.measure("transport", stream->name, [&] {
      stream->output.publish(photograph, {stream->sky.bodies(), light.day});
    });
  }
}

const light::Illumination& Streams::lightOf(Stream& stream) {
  studio_.stopwatch().measure("daylight", stream.name, [&] {
    if (stream.light && stream.light_version == stream.sky.version()) return;
    const SkyBodies& bodies = stream.sky.bodies();
    const sky::NightSky night{bodies.moon, bodies.map_from_celestial, stars_};
    stream.light = studio_.illumination(studio_.atmosphere().daylight(*bodies.sun, night));
    stream.light_version = stream.sky.version();
  });
  return *stream.light;
}

Streams::Stream& Streams::find(const std::string& condition) {
  std::string names;
  for (const auto& stream : streams_) {
    if (stream->name == condition || (condition.empty() && streams_.size() == 1)) return *stream;
    names += (names.empty() ? "" : ", ") + stream->name;
  }
  throw std::invalid_argument(
      "condition is \"" + condition + "\", but must be " +
      (names.empty() ? "empty: there is one sun, without a name" : "one of " + names));
}

Photograph Streams::view(const Shot& shot, const std::string& condition) {
  Stream& stream = find(condition);
  if (!stream.sky.ready()) {
    throw std::invalid_argument("condition \"" + condition + "\" has no sky yet: it waits for " +
                                stream.sky.missing());
  }
  studio_.look(shot.map_from_camera, shot.map_from_links);
  Developed developed = studio_.photograph(lightOf(stream), {shot.pose_index, stream.name});
  return {shot.pose_index, shot.stamp, developed.ev100, std::move(developed.picture)};
}

std::string Streams::waitsForSky() const {
  for (const auto& stream : streams_) {
    std::string missing = stream->sky.missing();
    if (!missing.empty()) return missing;
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
