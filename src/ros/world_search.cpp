#include "sunlit/ros/world_search.h"

#include <ros/package.h>

#include <map>
#include <mutex>
#include <utility>

namespace sunlit::ros_interface {

namespace {

/// Of each package that was asked for, since ROS starts a search through all its folders every time.
std::string packageFolder(const std::string& name) {
  static std::map<std::string, std::string> known;
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  const auto entry = known.find(name);
  return entry != known.end() ? entry->second : known[name] = ros::package::getPath(name);
}

}  // namespace

scene::SearchPath worldSearchPath(std::vector<std::string> folders) {
  scene::SearchPath path = scene::SearchPath::withEnvironment(std::move(folders));
  const std::string package = ros::package::getPath("sunlit");
  if (!package.empty()) path.folders.push_back(package + "/worlds/models");
  path.package_folder = packageFolder;
  return path;
}

}  // namespace sunlit::ros_interface
