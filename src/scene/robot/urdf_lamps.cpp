#include "scene/robot/urdf_lamps.h"

#include <tinyxml.h>

#include <sdf/Light.hh>
#include <sdf/Root.hh>

#include "scene/robot/urdf_gazebo.h"
#include "scene/sdf_library.h"
#include "scene/sdf_light.h"
#include "scene/sdf_pose.h"

namespace sunlit::scene {
namespace {

void addLamp(const TiXmlElement& element, const std::string& link, SceneBuilder& builder,
             std::vector<Lamp>* lamps) {
  TiXmlPrinter printer;
  element.Accept(&printer);
  const char* const given = element.Attribute("name");
  const std::string name = link + "::" + (given == nullptr ? "light" : given);
  sdf::Root root;
  const sdf::Errors errors =
      root.LoadSdfString("<sdf version='" SDF_PROTOCOL_VERSION "'>" + std::string(printer.CStr()) + "</sdf>");
  if (lightOf(root) == nullptr) {
    builder.warn("lights of <gazebo> elements could not be read",
                 name + (errors.empty() ? "" : " (" + errors[0].Message() + ")"));
    return;
  }
  // Of a light on its own, which stands in no other frame.
  const Eigen::Affine3d link_from_light(toEigen(lightOf(root)->RawPose()));
  if (std::optional<Lamp> lamp = lampOf(*lightOf(root), link_from_light, {name, link}, builder))
    lamps->push_back(*std::move(lamp));
}

}  // namespace

std::map<std::string, std::vector<Lamp>> urdfLamps(const std::string& text, SceneBuilder& builder) {
  std::map<std::string, std::vector<Lamp>> lamps;
  forEachGazebo(text, [&](const std::string& link, const TiXmlElement& gazebo) {
    for (const TiXmlElement* light = gazebo.FirstChildElement("light"); light != nullptr;
         light = light->NextSiblingElement("light"))
      addLamp(*light, link, builder, &lamps[link]);
  });
  return lamps;
}

}  // namespace sunlit::scene
