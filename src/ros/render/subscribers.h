/// Who listens to a topic, by the names of nodes.
#pragma once

#include <ros/node_handle.h>
#include <ros/this_node.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace sunlit::ros_interface {

/// How many nodes shall listen, and which of them count.
struct Audience {
  int size = 0;
  std::vector<std::string> of;  ///< names with all namespaces; empty: whoever
};

/// The other nodes that listen to one topic. Copies speak of the same ones.
class Subscribers {
 public:
  /// For the `Link`s that an advertised topic tells of, which ROS does on the thread that has its callbacks.
  template <typename Link>
  boost::function<void(const Link&)> joining() const {
    return [links = links_](const Link& link) {
      if (link.getSubscriberName() != ros::this_node::getName()) ++(*links)[link.getSubscriberName()];
    };
  }
  template <typename Link>
  boost::function<void(const Link&)> leaving() const {
    return [links = links_](const Link& link) {
      const auto node = links->find(link.getSubscriberName());
      if (node != links->end() && --node->second == 0) links->erase(node);
    };
  }
  /// A node counts once, by how many transports it may listen.
  bool are(const Audience& wanted) const;

 private:
  /// Of each node that listens now, at least one.
  std::shared_ptr<std::map<std::string, int>> links_ = std::make_shared<std::map<std::string, int>>();
};

/// A topic of messages of one type, and who listens to it.
class HeardTopic {
 public:
  HeardTopic() = default;  ///< of nothing
  template <typename Message>
  static HeardTopic of(ros::NodeHandle node, const std::string& topic, std::uint32_t queue_size) {
    using Link = ros::SingleSubscriberPublisher;
    HeardTopic heard;
    heard.publisher = node.advertise<Message>(topic, queue_size, heard.subscribers.joining<Link>(),
                                              heard.subscribers.leaving<Link>());
    return heard;
  }
  /// Its name if fewer listen; else empty.
  std::string ifLonely(const Audience& wanted) const {
    return subscribers.are(wanted) ? std::string() : publisher.getTopic();
  }

  ros::Publisher publisher;
  Subscribers subscribers;
};

}  // namespace sunlit::ros_interface
