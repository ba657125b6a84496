/// What Gazebo adds to a URDF.
#pragma once

#include <functional>
#include <map>
#include <string>

class TiXmlElement;

namespace sunlit::scene {

/// Calls `use` for each <gazebo reference="link"> of `text`, which is well-formed XML, in its order.
void forEachGazebo(const std::string& text,
                   const std::function<void(const std::string& link, const TiXmlElement& gazebo)>& use);

/// Names of Gazebo's materials, such as Gazebo/Blue, by the links that these give them to.
std::map<std::string, std::string> gazeboMaterialsOfLinks(const std::string& text);

}  // namespace sunlit::scene
