/// What is amiss with what a run is made from: world, robot, path, weather and star catalogue. Renderers of
/// the same find the same, so that of two that run side by side one is enough to warn.
#pragma once

#include <ros/console.h>

namespace sunlit::ros_interface {

/// Of lines about it, for ROS_LOG: a warning, or Info once it is left to another node.
ros::console::Level inputLevel();

/// From now on, in this process.
void leaveInputsToAnother();
bool areInputsLeftToAnother();

/// Whether ROS shuts down within 15 s, as it does where that other node has met the same fault.
bool doesAnotherEndAll();

}  // namespace sunlit::ros_interface
