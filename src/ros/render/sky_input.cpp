#include "ros/render/sky_input.h"

#include <ros/console.h>

#include <stdexcept>

namespace sunlit::ros_interface {

namespace {

/// While a picture is made the sky may move many times.
constexpr std::uint32_t kQueueSize = 100;

}  // namespace

SkyInput::SkyInput(const ros::NodeHandle& node, const std::string& prefix, bool night) : moments_(night) {
  subscribe(node, prefix + "sun", &sun_);
  if (!night) return;
  subscribe(node, prefix + "moon", &moon_);
  subscribe(node, prefix + "celestial", &celestial_);
}

template <typename Message>
void SkyInput::subscribe(ros::NodeHandle node, const std::string& name, Topic<Message>* topic) {
  const boost::function<void(const boost::shared_ptr<const Message>&)> taken =
      [this, topic](const boost::shared_ptr<const Message>& message) { take(*message, topic); };
  topic->subscriber = node.subscribe<Message>(name, kQueueSize, taken);
}

template <typename Message>
void SkyInput::take(const Message& message, Topic<Message>* topic) {
  try {
    moments_.put(message.header.stamp, fromMessage(message));
    topic->heard = true;
  } catch (const std::invalid_argument& error) {
    ROS_ERROR_THROTTLE(5.0, "Refused %s on %s: %s", topic->what.c_str(), topic->subscriber.getTopic().c_str(),
                       error.what());
  }
}

std::string SkyInput::missing() const {
  if (ready()) return std::string();
  if (!sun_.heard) return sun_.what + " on " + sun_.subscriber.getTopic();
  if (!moon_.heard) return moon_.what + " on " + moon_.subscriber.getTopic();
  if (!celestial_.heard) return celestial_.what + " on " + celestial_.subscriber.getTopic();
  return "sun, moon and stars of one stamp on " + sun_.subscriber.getTopic() + ", " +
         moon_.subscriber.getTopic() + " and " + celestial_.subscriber.getTopic();
}

}  // namespace sunlit::ros_interface
