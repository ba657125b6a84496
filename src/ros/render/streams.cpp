#include "ros/render/streams.h"

#include <ros/console.h>
#include <ros/names.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <stdexcept>

#include "ros/render/input_log.h"
#include "sunlit/quantity/memory.h"
#include "sunlit/studio/other_site.h"

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

/// As the parameter calls it.
std::string modeOf(image::ExposureOptions exposure) {
  return fieldOf(fieldsOf(exposure), "mode").text();
}

/// Of a picture between two skies that are `seconds` of ROS time apart.
void warnIfFarApart(double seconds, double rate) {
  constexpr double kMost_s = 1200.0;  // of the sun's clock: 5 deg, and the arc between is off by 0.02 deg
  const double passes_s = seconds * std::abs(rate);
  if (passes_s <= kMost_s) return;
  ROS_WARN_ONCE(
      "The sun comes every %.3f s, in which its clock goes on by %.0f s, and a picture between two suns that "
      "are more than %.0f s apart has one that never stood there: raise publish_rate of sun_position, or "
      "lower its rate",
      seconds, passes_s, kMost_s);
}

studio::SkyBodies inSky(const SkyBodies& bodies) {
  return {*bodies.sun, bodies.moon, bodies.map_from_celestial, bodies.site_elevation_m};
}

}  // namespace

Streams::Stream::Stream(const RenderConditions& conditions, std::size_t index, const StreamOptions& options,
                        const studio::Sky& skies)
    : name(conditions.all[index].named.name),
      weather(conditions.all[index].weather),
      setting{conditions.all[index].state, index},
      exposure_mode(modeOf(conditions.chains[index].exposure)),
      lag(conditions.chains[index].exposure),
      sky(skyNode(conditions.all[index].named, options),
          {skyPrefix(conditions.all[index].named, options), options.night, options.sky,
           options.output.frames.map,
           [this, &skies](double site_elevation_m) { skies.requireWeather(weather, site_elevation_m); }}),
      output(conditions.all[index].named.node(), options.output),
      state{name} {}

studio::Setting Streams::Stream::inTurn(std::int64_t index) {
  studio::Setting in_turn = setting;
  in_turn.adapted = [this, index](double metered_ev100) {
    lag.add(index, metered_ev100);
    return lag.ev100();
  };
  return in_turn;
}

void Streams::Stream::count(const Photograph& photograph) {
  const bool is_black = image::isBlack(photograph.picture);
  state = {name, state.images + 1, photograph.stamp, photograph.ev100, state.black, is_black};
  if (!is_black || state.black++ > 0) return;
  ROS_WARN("The picture%s at pose %d is black all over: %s More like it are counted",
           (name.empty() ? "" : " of " + name).c_str(), photograph.pose_index, image::kWhyBlack);
}

Streams::Streams(const RenderConditions& conditions, const StreamOptions& options, studio::Studio& studio,
                 studio::Sky& sky)
    : studio_(studio),
      sky_(sky),
      wanted_(options.wanted_subscribers),
      pose_output_(ros::NodeHandle(), ros::NodeHandle("~"), options.output) {
  for (std::size_t i = 0; i < conditions.all.size(); ++i)
    streams_.push_back(std::make_unique<Stream>(conditions, i, options, sky_));
}

void Streams::take(const Shot& shot, const std::optional<Shot>& next) {
  studio_.look(shot.map_from_camera, shot.map_from_links, shot.motion);
  countView(shot);
  std::future<void> exposed = std::async(std::launch::async, [&] { expose(shot); });
  if (next) studio_.lookAhead(next->map_from_camera, next->map_from_links);
  exposed.get();
}

void Streams::countView(const Shot& shot) {
  ++poses_;
  const std::optional<studio::ViewFault> fault = studio_.viewFault();
  if (!fault || faulty_poses_[fault->poses]++ > 0) return;
  ROS_LOG(inputLevel(), ROSCONSOLE_DEFAULT_NAME, "At pose %d %s. More like it are counted", shot.pose_index,
          fault->reason.c_str());
}

void Streams::expose(const Shot& shot) {
  studio::Stopwatch& stopwatch = studio_.stopwatch();
  const image::DepthImage depth = studio_.depth();
  stopwatch.measure("send", "pose", [&] { pose_output_.publish(shot.map_from_camera, depth, shot.stamp); });
  for (const auto& stream : streams_) {
    stream->sky.forgetBefore(shot.stamp);
    const SkyBodies bodies = stream->sky.at(shot.stamp).value();
    warnIfFarApart(stream->sky.spacing(shot.stamp), bodies.time.rate);
    const light::Illumination& light = lightOf(*stream, bodies, shot.stamp);
    const image::PictureName name{shot.chance, stream->name, shot.drive};
    studio::Developed developed = studio_.photograph(light, name, stream->inTurn(shot.pose_index));
    Photograph photograph{shot.pose_index, shot.stamp, developed.ev100, std::move(developed.picture),
                          stream->exposure_mode};
    if (studio_.hasRight())
      photograph.right = studio_.photographRight(light, name, photograph.ev100, stream->setting);
    stopwatch.measure("send", stream->name, [&] { stream->output.publish(photograph, {bodies, light.day}); });
    stream->count(photograph);
  }
}

std::int64_t Streams::firstUnmetered(std::int64_t index) const {
  std::int64_t first = index;
  for (const auto& stream : streams_) {
    if (stream->lag.memory() > 0) first = std::min(first, stream->lag.firstMissing(index));
  }
  return first;
}

void Streams::meter(const Shot& shot, const Shot& target) {
  studio_.lookByLeft(shot.map_from_camera, shot.map_from_links, shot.motion);
  for (const auto& stream : streams_) {
    if (shot.pose_index < stream->lag.firstMissing(target.pose_index)) continue;
    const light::Illumination& light = lightOf(*stream, stream->sky.at(target.stamp).value(), shot.stamp);
    stream->lag.add(shot.pose_index, studio_.meter(light, {shot.pose_index, stream->name}, stream->setting));
  }
}

const light::Illumination& Streams::lightOf(Stream& stream, const SkyBodies& bodies, const ros::Time& stamp) {
  studio_.stopwatch().measure("daylight", stream.name, [&] {
    const bool drifts = sky::moves(stream.weather) && stream.weather.clock_s != stamp.toSec();
    if (stream.light && shineAlike(stream.lit_by, bodies) && !drifts) return;
    if (stream.light) keepFreedMemory();  // a sky that moves needs as much each time
    stream.weather.clock_s = stamp.toSec();
    const studio::SkyBodies in_sky = inSky(bodies);
    const std::size_t state = stream.setting.state;
    if (!sky_.isPrepared(in_sky.site_elevation_m, state))
      studio_.stopwatch().measure("load", "atmosphere",
                                  [&] { sky_.prepare(in_sky.site_elevation_m, state); });
    stream.light = studio_.illumination(sky_.daylight(in_sky, stream.weather, state), state);
    stream.lit_by = bodies;
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
  if (stream.sky.newest() == nullptr) {
    throw std::invalid_argument("condition \"" + condition + "\" has no sky yet: it waits for " +
                                stream.sky.missing());
  }
  studio_.lookByLeft(shot.map_from_camera, shot.map_from_links, shot.motion);
  studio::Developed developed = studio_.photograph(lightOf(stream, *stream.sky.newest(), shot.stamp),
                                                   {shot.pose_index, stream.name}, stream.setting);
  return {shot.pose_index, shot.stamp, developed.ev100, std::move(developed.picture)};
}

bool Streams::isOver(const scene::WorldSite& world) const {
  const SkyBodies& bodies = *streams_.front()->sky.newest();
  return bodies.time.utc && studio::isSkyOver(world, inSky(bodies), *bodies.time.utc);
}

std::string Streams::waitsForSky() const {
  for (const auto& stream : streams_) {
    std::string missing = stream->sky.missing();
    if (!missing.empty()) return missing;
  }
  return std::string();
}

Wait Streams::waitsForSky(const ros::Time& stamp) const {
  for (const auto& stream : streams_) {
    Wait missing = stream->sky.missing(stamp);
    if (!missing.empty()) return missing;
  }
  return {};
}

ros::Time Streams::newestSky() const {
  ros::Time newest;
  for (const auto& stream : streams_) newest = std::max(newest, stream->sky.newestStamp());
  return newest;
}

double Streams::skySpacing(const ros::Time& stamp) const {
  double spacing = 0.0;
  for (const auto& stream : streams_) spacing = std::max(spacing, stream->sky.spacing(stamp));
  return spacing;
}

bool Streams::missedSky(const ros::Time& stamp) const {
  return std::any_of(streams_.begin(), streams_.end(),
                     [&](const auto& stream) { return stream->sky.missed(stamp); });
}

std::string Streams::waitsForSubscribers() const {
  std::string topic;
  for (const auto& stream : streams_)
    if (topic.empty()) topic = stream->output.lonelyTopic(wanted_);
  if (topic.empty()) topic = pose_output_.lonelyTopic(wanted_);
  if (topic.empty()) return topic;
  std::string waited_for = "subscribers of " + topic;
  if (!wanted_.of.empty()) waited_for += ", of which only these count:";
  for (const std::string& node : wanted_.of) waited_for += " " + node;
  return waited_for;
}

}  // namespace sunlit::ros_interface
