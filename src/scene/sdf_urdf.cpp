#include "scene/sdf_urdf.h"

#include <algorithm>
#include <map>
#include <sdf/Exception.hh>
#include <sdf/parser.hh>
#include <set>
#include <stdexcept>
#include <vector>

#include "scene/sdf_console.h"
#include "scene/sdf_schema.h"
#include "scene/sdf_xml.h"

namespace sunlit::scene {
namespace {

using tinyxml2::XMLElement;

void refuseMacros(XMLElement& robot, const std::string& file) {
  forEachBelow(robot, [&](const XMLElement& element) {
    const std::string kind = element.Value();
    if (kind.rfind("xacro:", 0) == 0)
      throw std::runtime_error(placeOf(file, element) + ": <" + kind +
                               "> is a macro; turn this file into a URDF first, by xacro");
  });
}

/// libsdformat would make model:// of package://, and packages are no models.
void resolvePackages(XMLElement& robot, const std::string& file, const ResourceFinder& finder) {
  forEachBelow(robot, [&](XMLElement& element) {
    const std::string uri = attributeOf(element, "filename");
    if (std::string(element.Value()) != "mesh" || uri.rfind("package://", 0) != 0) return;
    const Found found = finder.find(uri, file);
    if (found.file) element.SetAttribute("filename", ("file://" + *found.file).c_str());
  });
}

/// libsdformat knows no pictures of URDF, and would make them black: a material keeps the colour that stands
/// beside its picture, and is left out where it has none.
void dropPictures(XMLElement& robot, const std::string& file, SceneBuilder& builder) {
  std::vector<XMLElement*> plain;  // materials without pictures
  std::vector<XMLElement*> with_texture;
  std::set<std::string> colored, dropped;  // names
  forEachBelow(robot, [&](XMLElement& element) {
    if (std::string(element.Value()) != "material") return;
    if (element.FirstChildElement("color") != nullptr) colored.insert(attributeOf(element, "name"));
    (element.FirstChildElement("texture") == nullptr ? plain : with_texture).push_back(&element);
  });
  for (XMLElement* material : with_texture) {
    XMLElement* const texture = material->FirstChildElement("texture");
    const std::string name = attributeOf(*material, "name");
    const bool has_color = material->FirstChildElement("color") != nullptr;
    if (!attributeOf(*texture, "filename").empty())
      builder.warn(kNotRendered, "material " + name + " of " + file +
                                     ": its texture, which a URDF has none of within SDF: " +
                                     (has_color ? "in its colour" : "without the material"));
    if (has_color) {
      material->DeleteChild(texture);
    } else {
      if (!name.empty()) dropped.insert(name);
      material->Parent()->DeleteChild(material);
    }
  }
  for (XMLElement* material : plain) {
    const std::string name = attributeOf(*material, "name");
    if (dropped.count(name) == 1 && colored.count(name) == 0) material->Parent()->DeleteChild(material);
  }
}

/// The links that libsdformat makes one with the links that they hang from at fixed joints, by name. It
/// leaves joints as they are where an extension of Gazebo's says so, and at the world.
std::map<std::string, std::string> lumpedInto(XMLElement& robot) {
  std::set<std::string> kept_joints;
  for (const XMLElement* gazebo : childrenOf(robot, "gazebo")) {
    for (const char* const flag : {"preserveFixedJoint", "disableFixedJointLumping"}) {
      const std::string value = childText(*gazebo, flag);
      if (value == "true" || value == "1") kept_joints.insert(attributeOf(*gazebo, "reference"));
    }
  }
  const auto linkOf = [](XMLElement& joint, const char* end) {
    const XMLElement* const named = joint.FirstChildElement(end);
    return named == nullptr ? "" : attributeOf(*named, "link");
  };
  std::map<std::string, std::string> parents;
  for (XMLElement* joint : childrenOf(robot, "joint")) {
    const std::string parent = linkOf(*joint, "parent");
    if (attributeOf(*joint, "type") == "fixed" && parent != "world" &&
        kept_joints.count(attributeOf(*joint, "name")) == 0)
      parents.emplace(linkOf(*joint, "child"), parent);
  }
  return parents;
}

/// libsdformat says nothing of links that it leaves out.
void nameLinksLeftOut(XMLElement& robot, const std::string& made, const std::string& file,
                      SceneBuilder& builder) {
  const std::map<std::string, std::string> lumped_into = lumpedInto(robot);
  for (XMLElement* link : childrenOf(robot, "link")) {
    const std::string name = attributeOf(*link, "name");
    std::string drawn_by = name;
    std::set<std::string> passed;  // joints may go in circles
    for (auto to = lumped_into.find(drawn_by); to != lumped_into.end() && passed.insert(drawn_by).second;
         to = lumped_into.find(drawn_by))
      drawn_by = to->second;
    const bool is_there = made.find("<link name='" + drawn_by + "'") != std::string::npos;
    if (link->FirstChildElement("visual") != nullptr && !is_there)
      builder.warn(
          "links of URDF files within SDF were left out, they or what they hang from have no <inertial>",
          name + " of " + file);
  }
}

}  // namespace

std::unique_ptr<tinyxml2::XMLDocument> sdfOfUrdf(tinyxml2::XMLDocument& urdf, const std::string& file,
                                                 const ResourceFinder& finder, SceneBuilder& builder) {
  XMLElement& robot = *urdf.RootElement();
  refuseMacros(robot, file);
  resolvePackages(robot, file, finder);
  dropPictures(robot, file, builder);
  tinyxml2::XMLPrinter printer;
  urdf.Print(&printer);
  const SdfConsole console;
  const sdf::SDFPtr made = emptySdf();
  sdf::Errors errors;
  bool is_read = false;
  std::string why;
  try {
    is_read = sdf::readString(printer.CStr(), made, errors);
  } catch (const sdf::Exception& error) {  // which is no std::exception
    why = error.GetErrorStr();
  } catch (const std::exception& error) {
    why = error.what();
  }
  const std::vector<std::string> lines = console.lines();
  if (!is_read) {
    if (why.empty())
      why = !errors.empty() ? errors[0].Message() : !lines.empty() ? lines[0] : "it gives no reason";
    throw std::runtime_error(file + ": libsdformat cannot read this URDF: " + why);
  }
  for (const std::string& line : lines) builder.warn("× libsdformat, of a URDF", line);
  // On one line, since none is one of the file.
  std::string text = made->Root()->ToString("");
  nameLinksLeftOut(robot, text, file, builder);
  std::replace(text.begin(), text.end(), '\n', ' ');
  auto document = std::make_unique<tinyxml2::XMLDocument>();
  document->Parse(text.data(), text.size());
  if (document->FirstChildElement("sdf") == nullptr)
    throw std::runtime_error(file + ": libsdformat makes nothing of this URDF");
  return document;
}

}  // namespace sunlit::scene
