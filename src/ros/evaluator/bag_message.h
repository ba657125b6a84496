/// Messages of bags, of the type that they must have.
#pragma once

#include <ros/message_traits.h>
#include <rosbag/message_instance.h>

#include <boost/shared_ptr.hpp>
#include <stdexcept>
#include <string>

namespace sunlit::ros_interface {

/// Throws std::runtime_error that names `topic` where messages of that type are no images.
inline void requireImage(const std::string& topic, const std::string& type, bool may_be_compressed) {
  if (type == "sensor_msgs/Image" || (may_be_compressed && type == "sensor_msgs/CompressedImage")) return;
  throw std::runtime_error(topic + " is " + type + ", not sensor_msgs/Image" +
                           (may_be_compressed ? " or sensor_msgs/CompressedImage" : ""));
}

/// Throws std::runtime_error that names the topic where it is of another type, or of another definition of
/// this one: such cannot be read.
template <typename Message>
boost::shared_ptr<Message> messageOf(const rosbag::MessageInstance& instance) {
  if (auto message = instance.instantiate<Message>()) return message;
  const std::string wanted = ros::message_traits::DataType<Message>::value(), is = instance.getDataType();
  throw std::runtime_error(instance.getTopic() + " is " + is +
                           (is == wanted
                                ? " as another version defines it: convert the bag (rosbag fix), or leave "
                                  "the topic out (rosbag filter)"
                                : ", not " + wanted));
}

}  // namespace sunlit::ros_interface
