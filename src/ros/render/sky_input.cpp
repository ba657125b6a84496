#include "ros/render/sky_input.h"

#include <ros/console.h>
#include <ros/message_event.h>

#include <stdexcept>
#include <utility>

#include "ros/conversions/time.h"
#include "sunlit/quantity/range.h"
#include "sunlit/ros/topic_names.h"

namespace sunlit::ros_interface {

namespace {

/// While a picture is made the sky may move many times; none of them may be lost.
constexpr std::uint32_t kQueueSize = 20000;

}  // namespace

SkyInput::SkyInput(const ros::NodeHandle& node, const SkyInputOptions& options)
    : moments_(options.night, options.rule),
      map_frame_(options.map_frame),
      require_site_(options.require_site) {
  subscribe(node, options.prefix + topics::kSun, &sun_);
  if (!options.night) return;
  subscribe(node, options.prefix + topics::kMoon, &moon_);
  subscribe(node, options.prefix + topics::kCelestial, &celestial_);
}

template <typename Message>
void SkyInput::subscribe(ros::NodeHandle node, const std::string& name, Topic<Message>* topic) {
  using Event = ros::MessageEvent<const Message>;
  const boost::function<void(const Event&)> taken = [this, topic](const Event& event) {
    watchSender(event.getPublisherName(), topic);
    take(*event.getMessage(), topic);
  };
  topic->subscriber = node.subscribe<Message, const Event&>(name, kQueueSize, taken);
}

// A node that takes the place of another is no fault; one that goes on after that other has spoken is.
template <typename Message>
void SkyInput::watchSender(const std::string& sender, Topic<Message>* topic) {
  const std::string other = std::exchange(topic->sender, sender);
  if (topic->senders.insert(sender).second || sender == other) return;
  topic->mixed = true;
  if (std::exchange(warned_of_senders_, true)) return;
  ROS_WARN("%s and %s send %s on %s in turn: pictures are under now the one's sky, now the other's",
           other.c_str(), sender.c_str(), topic->what.c_str(), topic->subscriber.getTopic().c_str());
}

template <typename Message>
void SkyInput::take(const Message& message, Topic<Message>* topic) {
  try {
    put(message);
    topic->heard = true;
    topic->refused = false;
  } catch (const std::invalid_argument& error) {
    topic->refused = true;
    ++refused_;
    if (refusals_.isTime(topic->what))
      ROS_ERROR("Refused %s on %s: %s", topic->what.c_str(), topic->subscriber.getTopic().c_str(),
                error.what());
  }
}

void SkyInput::put(const SunPosition& message) {
  const SkyTime time{fromUtc(message.utc), message.rate};
  const sky::SunInSky sun = fromMessage(message, map_frame_);
  const double elevation_m = siteElevationOf(message);
  requireSite(elevation_m);
  moments_.put(message.header.stamp, sun, time, elevation_m);
  site_elevation_m_ = elevation_m;
}

// A site where a run begins ends it, as any parameter that does not fit; one that is set later does not.
void SkyInput::requireSite(double elevation_m) {
  if (!site_elevation_m_ || *site_elevation_m_ == elevation_m) return;
  try {
    require_site_(elevation_m);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("at the elevation of its site, " + textOf(elevation_m) + " m, " +
                                error.what() + ". Until the site is set again its suns do not count");
  }
}

void SkyInput::put(const MoonPosition& message) {
  moments_.put(message.header.stamp, fromMessage(message, map_frame_));
}

void SkyInput::put(const geometry_msgs::QuaternionStamped& message) {
  moments_.put(message.header.stamp, fromMessage(message, map_frame_));
}

std::string SkyInput::mixedTopics() const {
  std::string names;
  const auto add = [&names](const auto& topic) {
    if (topic.mixed && topic.subscriber.getNumPublishers() > 1)
      names += (names.empty() ? "" : ", ") + topic.subscriber.getTopic();
  };
  add(sun_);
  add(moon_);
  add(celestial_);
  return names;
}

const SkyBodies* SkyInput::newest() const {
  return moments_.whole().empty() ? nullptr : &moments_.whole().rbegin()->second;
}

std::string SkyInput::missing() const {
  if (newest() != nullptr) return std::string();
  if (!sun_.heard) return sun_.what + " on " + sun_.subscriber.getTopic();
  if (!moon_.heard) return moon_.what + " on " + moon_.subscriber.getTopic();
  if (!celestial_.heard) return celestial_.what + " on " + celestial_.subscriber.getTopic();
  return "sun, moon and stars of one stamp on " + sun_.subscriber.getTopic() + ", " +
         moon_.subscriber.getTopic() + " and " + celestial_.subscriber.getTopic();
}

Wait SkyInput::missing(const ros::Time& stamp) const {
  if (newest() == nullptr) return missing();
  if (moments_.at(stamp)) return {};
  // Neither the stamp of a camera that goes on nor that of a sky that does makes it another wait.
  const std::string key = "a sky on " + sun_.subscriber.getTopic();
  const std::string wanted = "the sky of " + textOfStamp(stamp) + " on " + sun_.subscriber.getTopic();
  const std::string newest = textOfStamp(newestStamp());
  if (!moments_.missed(stamp)) return {wanted + ", which stands at " + newest, key};
  return {wanted + ", which has begun with " + textOfStamp(moments_.whole().begin()->first) +
              " and gone on to " + newest + " without it: a sun must begin before, or stand still (rate 0)",
          key};
}

}  // namespace sunlit::ros_interface
