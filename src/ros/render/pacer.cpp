#include "ros/render/pacer.h"

#include <algorithm>

namespace sunlit::ros_interface {

Pacer::Pacer(ros::NodeHandle node, const std::vector<std::string>& topics, int max_ahead)
    : max_ahead_(max_ahead) {
  for (const std::string& topic : topics) {
    auto reader = std::make_shared<Reader>();
    // Only the newest count matters.
    reader->subscriber = node.subscribe<std_msgs::UInt32>(
        topic, 1, [reader = reader.get()](const std_msgs::UInt32ConstPtr& progress) {
          reader->done = static_cast<int>(progress->data);
          reader->heard = true;
        });
    readers_.push_back(reader);
  }
}

const Pacer::Reader* Pacer::slowestReader() const {
  const auto found = std::min_element(readers_.begin(), readers_.end(),
                                      [](const auto& a, const auto& b) { return a->done < b->done; });
  return found == readers_.end() ? nullptr : found->get();
}

int Pacer::slowest() const {
  const Reader* reader = slowestReader();
  return reader == nullptr ? 0 : reader->done;
}

std::string Pacer::slowestTopic() const {
  const Reader* reader = slowestReader();
  return reader == nullptr ? std::string() : reader->subscriber.getTopic();
}

std::string Pacer::silentTopic() const {
  for (const auto& reader : readers_) {
    if (!reader->heard) return reader->subscriber.getTopic();
  }
  return std::string();
}

}  // namespace sunlit::ros_interface
