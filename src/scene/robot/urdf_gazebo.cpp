#include "scene/robot/urdf_gazebo.h"

#include <tinyxml.h>

#include <sstream>

namespace sunlit::scene {

void forEachGazebo(const std::string& text,
                   const std::function<void(const std::string& link, const TiXmlElement& gazebo)>& use) {
  TiXmlDocument document;
  document.Parse(text.c_str(), nullptr, TIXML_ENCODING_UTF8);
  const TiXmlElement* const robot = document.FirstChildElement("robot");
  if (robot == nullptr) return;
  for (const TiXmlElement* gazebo = robot->FirstChildElement("gazebo"); gazebo != nullptr;
       gazebo = gazebo->NextSiblingElement("gazebo")) {
    if (const char* const link = gazebo->Attribute("reference"); link != nullptr) use(link, *gazebo);
  }
}

std::map<std::string, GazeboMaterial> gazeboMaterialsOfLinks(const std::string& text) {
  std::map<std::string, GazeboMaterial> materials;
  forEachGazebo(text, [&](const std::string& link, const TiXmlElement& gazebo) {
    const TiXmlElement* const material = gazebo.FirstChildElement("material");
    if (const char* const written = material == nullptr ? nullptr : material->GetText())
      std::istringstream(written) >> materials[link].name;
    for (const TiXmlElement* visual = gazebo.FirstChildElement("visual"); visual != nullptr;
         visual = visual->NextSiblingElement("visual")) {
      const TiXmlElement* const look = visual->FirstChildElement("material");
      if (look == nullptr || look->FirstChildElement() == nullptr) continue;
      TiXmlPrinter printer;
      look->Accept(&printer);
      materials[link].element = printer.CStr();
    }
  });
  return materials;
}

}  // namespace sunlit::scene
