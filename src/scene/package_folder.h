/// Packages of ROS, found without it.
#pragma once

#include <string>

namespace sunlit::scene {

/// The folder of a package: of those below the folders in ROS_PACKAGE_PATH (colon-separated) the first whose
/// package.xml has this name, else /usr/share/`name`, where Debian has its own. Empty if there is none.
/// Folders are looked through as rospack does: none within a package, none that is hidden or holds a
/// CATKIN_IGNORE. What was found is remembered; any thread may ask.
std::string packageFolder(const std::string& name);

}  // namespace sunlit::scene
