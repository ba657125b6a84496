#include "sunlit/ros/node_main.h"

#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>

#include <csignal>
#include <cstdio>
#include <exception>

namespace sunlit::ros_interface {

namespace {

volatile std::sig_atomic_t is_interrupted = 0;

void onInterrupt(int number) {
  is_interrupted = 1;
  std::signal(number, SIG_DFL);
}

// As roscpp's own handler of SIGINT.
void onTermination(int) {
  ros::requestShutdown();
}

int refuse(const std::string& word, const std::string& name) {
  const bool help = word == "--help" || word == "-h";
  if (!help) std::fprintf(stderr, "%s: there is no option %s\n", name.c_str(), word.c_str());
  std::fprintf(help ? stdout : stderr,
               "%s_node takes ROS parameters; config/%s.yaml explains them, launch/%s.launch sets them\n",
               name.c_str(), name.c_str(), name.c_str());
  return help ? 0 : 1;
}

}  // namespace

int runNode(int argc, char** argv, const std::string& name, const std::function<int()>& node) {
  ros::init(argc, argv, name);
  if (argc > 1) return refuse(argv[1], name);  // ROS has taken what it knows
  // roscpp and its console end with the last handle: without this one, an exception that destroys the node's
  // own handles on its way here could no longer be printed.
  std::signal(SIGTERM, onTermination);
  std::signal(SIGXFSZ, SIG_IGN);  // a file beyond ulimit -f is an error with a name, no silent end
  const ros::NodeHandle alive;
  try {
    return node();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
}

void holdInterrupts() {
  std::signal(SIGINT, onInterrupt);
  std::signal(SIGTERM, onInterrupt);
}

bool isInterrupted() {
  return is_interrupted != 0;
}

}  // namespace sunlit::ros_interface
