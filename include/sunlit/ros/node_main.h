/// What every node's main() shares.
#pragma once

#include <functional>
#include <string>

namespace sunlit::ros_interface {

/// Initialises ROS under `name` and runs `node`, whose result is the exit status of the process. An exception
/// becomes one fatal line and exit status 1, and so does, without a master, an argument that ROS does not
/// take; `--help` tells where the parameters are explained.
int runNode(int argc, char** argv, const std::string& name, const std::function<int()>& node);

}  // namespace sunlit::ros_interface
