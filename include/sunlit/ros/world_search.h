/// Where worlds named in ROS look for their models.
#pragma once

#include <string>
#include <vector>

#include "sunlit/scene/load.h"

namespace sunlit::ros_interface {

/// `folders` and the environment's (scene::SearchPath::withEnvironment), then this package's own
/// worlds/models, which has the `sun` and `ground_plane` that most Gazebo worlds include. Packages are those
/// of ROS.
scene::SearchPath worldSearchPath(std::vector<std::string> folders);

}  // namespace sunlit::ros_interface
