#include "scene/sdf_urdf.h"

#include <algorithm>
#include <sdf/Exception.hh>
#include <set>
#include <stdexcept>
#include <vector>

#include "scene/sdf_console.h"
#include "scene/sdf_library.h"
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

/// libsdformat says nothing of links that it leaves out. Those at fixed joints are in the names of their
/// visuals.
void nameLinksLeftOut(XMLElement& robot, const std::string& made, const std::string& file,
                      SceneBuilder& builder) {
  for (XMLElement* link : childrenOf(robot, "link")) {
    const std::string name = attributeOf(*link, "name");
    const bool is_there = made.find("<link name='" + name + "'") != std::string::npos ||
                          made.find("_fixed_joint_lump__" + name + "_") != std::string::npos;
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
