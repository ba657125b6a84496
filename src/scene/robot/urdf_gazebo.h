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

/// How Gazebo's elements have the visuals of a link look.
struct GazeboMaterial {
  std::string name;  ///< of <material>: that of one of Gazebo's, such as Gazebo/Blue; empty: none
  std::string
      element;  ///< of <visual>: a whole <material> as SDF has it; empty: none. It comes before the name
};

/// By the links that these are given to.
std::map<std::string, GazeboMaterial> gazeboMaterialsOfLinks(const std::string& text);

}  // namespace sunlit::scene
