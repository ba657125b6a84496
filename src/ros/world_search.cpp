#include "sunlit/ros/world_search.h"

#include <ros/package.h>

#include <utility>

namespace sunlit::ros_interface {

scene::SearchPath worldSearchPath(std::vector<std::string> folders) {
  scene::SearchPath path = scene::SearchPath::withEnvironment(std::move(folders));
  const std::string package = ros::package::getPath("sunlit");
  if (!package.empty()) path.folders.push_back(package + "/worlds/models");
  return path;
}

}  // namespace sunlit::ros_interface
