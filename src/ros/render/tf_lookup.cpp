#include "ros/render/tf_lookup.h"

#include <ros/console.h>
#include <tf2/exceptions.h>

#include "ros/conversions/geometry.h"
#include "ros/steady.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/quantity/range.h"

namespace sunlit::ros_interface {

FoundTransform lookUp(const tf2_ros::Buffer& tf, const std::string& parent, const std::string& child,
                      const ros::Time& stamp) {
  const geometry_msgs::TransformStamped found = tf.lookupTransform(parent, child, stamp);
  const Eigen::Isometry3d parent_from_child = fromTransform(found.transform);
  // Written so that NaN fails, too.
  if (!(parent_from_child.matrix().array().abs() <= kFarthestPose_m).all()) {
    const std::string fault =
        "is not finite, or farther than " + textOf(kFarthestPose_m / 1000.0) + " km away";
    static Throttle told(5.0);
    if (told.isTime(child))
      ROS_WARN("The transform from %s to %s on TF %s: it is not used", parent.c_str(), child.c_str(),
               fault.c_str());
    throw tf2::InvalidArgumentException("its transform from " + parent + " " + fault);
  }
  return {parent_from_child, found.header.stamp};
}

}  // namespace sunlit::ros_interface
