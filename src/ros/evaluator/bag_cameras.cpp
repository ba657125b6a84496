#include "ros/evaluator/bag_cameras.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "ros/conversions/time.h"
#include "ros/evaluator/bag_message.h"
#include "ros/evaluator/bag_topics.h"

namespace sunlit::ros_interface {
namespace {

bool isOne(const sensor_msgs::CameraInfo& a, const sensor_msgs::CameraInfo& b) {
  const auto of = [](const sensor_msgs::CameraInfo& camera) {
    return std::tie(camera.width, camera.height, camera.distortion_model, camera.D, camera.K);
  };
  return of(a) == of(b);
}

/// What a bag tells at a stamp.
struct Told {
  std::size_t bag;
  sensor_msgs::CameraInfo::ConstPtr camera;
};

}  // namespace

void requireOneCamera(const std::vector<std::string>& bags, const std::vector<std::string>& topics) {
  if (bags.size() < 2) return;
  std::map<std::pair<std::string, ros::Time>, Told> told;
  const auto note = [&](std::size_t b, const rosbag::MessageInstance& instance) {
    const auto camera = messageOf<sensor_msgs::CameraInfo>(instance);
    const std::string topic = withSlash(instance.getTopic());
    const auto [first, is_new] = told.try_emplace({topic, camera->header.stamp}, Told{b, camera});
    if (is_new || first->second.bag == b || isOne(*first->second.camera, *camera)) return;
    throw std::runtime_error(bags[first->second.bag] + " and " + bags[b] + " are of two cameras: " + topic +
                             " differs at stamp " + textOfStamp(camera->header.stamp) +
                             "; evaluate each by itself, or one beside the other by --map " +
                             bags[first->second.bag] + " --query " + bags[b]);
  };
  for (std::size_t b = 0; b < bags.size(); ++b) {
    const auto bag = openBag(bags[b]);
    readingBag(bags[b], [&] {
      rosbag::View view(*bag, topicQuery(topics));
      for (const rosbag::MessageInstance& instance : view) note(b, instance);
    });
  }
}

}  // namespace sunlit::ros_interface
