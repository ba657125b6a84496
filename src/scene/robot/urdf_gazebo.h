/// What Gazebo adds to a URDF, but for its lights.
#pragma once

#include <map>
#include <string>

namespace sunlit::scene {

/// Names of Gazebo's materials, such as Gazebo/Blue, by the links that <gazebo reference="link"> gives them
/// to. `text` is well-formed XML.
std::map<std::string, std::string> gazeboMaterialsOfLinks(const std::string& text);

}  // namespace sunlit::scene
