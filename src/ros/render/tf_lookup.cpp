#include "ros/render/tf_lookup.h"

#include <ros/console.h>
#include <tf2/exceptions.h>

#include "ros/conversions/geometry.h"
#include "ros/steady.h"

namespace sunlit::ros_interface {

FoundTransform lookUp(const tf2_ros::Buffer& tf, const std::string& parent, const std::string& child,
                      const ros::Time& stamp) {
  const geometry_msgs::TransformStamped found = tf.lookupTransform(parent, child, stamp);
  const Eigen::Isometry3d parent_from_child = fromTransform(found.transform);
  if (!parent_from_child.matrix().allFinite()) {
    static Throttle told(5.0);
    if (told.isTime(child))
      ROS_WARN("The transform from %s to %s on TF is not finite: it is not used", parent.c_str(),
               child.c_str());
    throw tf2::InvalidArgumentException("its transform from " + parent + " is not finite");
  }
  return {parent_from_child, found.header.stamp};
}

}  // namespace sunlit::ros_interface
