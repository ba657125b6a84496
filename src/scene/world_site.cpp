#include "sunlit/scene/world_site.h"

#include <memory>

#include "scene/mesh_file.h"
#include "scene/sdf_xml.h"

namespace sunlit::scene {
namespace {

/// The first element of this name in a world; null where there is none.
const tinyxml2::XMLElement* findInWorlds(const tinyxml2::XMLDocument& document, const char* name) {
  const tinyxml2::XMLElement* world = document.FirstChildElement("sdf");
  if (world != nullptr) world = world->FirstChildElement("world");
  for (; world != nullptr; world = world->NextSiblingElement("world")) {
    const tinyxml2::XMLElement* found = world->FirstChildElement(name);
    if (found != nullptr) return found;
  }
  return nullptr;
}

}  // namespace

std::optional<WorldSite> siteOf(const std::string& world, const SearchPath& search_path) {
  const std::string file = requireWorld(world, search_path);
  const std::string extension = extensionOf(file);
  if (extension != ".world" && extension != ".sdf") return std::nullopt;
  const std::unique_ptr<tinyxml2::XMLDocument> document = readSdfXml(file);
  const tinyxml2::XMLElement* element = findInWorlds(*document, "spherical_coordinates");
  if (element == nullptr) return std::nullopt;
  const double latitude = childNumber(*element, "latitude_deg"),
               longitude = childNumber(*element, "longitude_deg");
  if (latitude == 0.0 && longitude == 0.0) return std::nullopt;
  return WorldSite{{Angle::degrees(latitude), Angle::degrees(longitude), childNumber(*element, "elevation")},
                   placeOf(file, *element)};
}

}  // namespace sunlit::scene
