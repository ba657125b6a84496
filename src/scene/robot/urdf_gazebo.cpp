#include "scene/robot/urdf_gazebo.h"

#include <tinyxml.h>

#include <sstream>

namespace sunlit::scene {

std::map<std::string, std::string> gazeboMaterialsOfLinks(const std::string& text) {
  TiXmlDocument document;
  document.Parse(text.c_str(), nullptr, TIXML_ENCODING_UTF8);
  std::map<std::string, std::string> names;
  const TiXmlElement* const robot = document.FirstChildElement("robot");
  if (robot == nullptr) return names;
  for (const TiXmlElement* gazebo = robot->FirstChildElement("gazebo"); gazebo != nullptr;
       gazebo = gazebo->NextSiblingElement("gazebo")) {
    const char* const link = gazebo->Attribute("reference");
    const TiXmlElement* const material = gazebo->FirstChildElement("material");
    const char* const written = material == nullptr ? nullptr : material->GetText();
    if (link == nullptr || written == nullptr) continue;
    std::istringstream words(written);
    words >> names[link];
  }
  return names;
}

}  // namespace sunlit::scene
