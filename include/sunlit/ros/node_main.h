/// What every node's main() shares.
#pragma once

#include <functional>
#include <string>

namespace sunlit::ros_interface {

/// Initialises ROS under `name` and runs `node`, whose result is the exit status of the process. An exception
/// becomes one fatal line and exit status 1, and so does, without a master, an argument that ROS does not
/// take; `--help` tells where the parameters are explained.
/// SIGTERM ends a node as SIGINT does: containers stop so. A node that roslaunch started and that sees it
/// gone ends, too, whatever ended that: as by SIGINT, or at once while it still waits for a master.
int runNode(int argc, char** argv, const std::string& name, const std::function<int()>& node);

/// From here on SIGINT and SIGTERM only make isInterrupted() true, and leave it to the node to end, with its
/// topics and log at hand. A second one of the same kind ends the process at once.
void holdInterrupts();
bool isInterrupted();

}  // namespace sunlit::ros_interface
