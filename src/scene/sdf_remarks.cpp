#include "scene/sdf_remarks.h"

#include <cmath>
#include <cstdint>
#include <set>
#include <sstream>

#include "scene/sdf_xml.h"
#include "sunlit/quantity/range.h"

namespace sunlit::scene {
namespace {

using tinyxml2::XMLElement;

/// The flags of a visual that has none.
constexpr std::uint32_t kEveryCamera = 0xFFFFFFFF;

/// Elements of numbers alone; in a height map's <texture> two of them are pictures.
const std::set<std::string> kOfNumbers = {
    "pose",         "size",         "radius",        "length",    "scale",      "radii",     "point",
    "normal",       "height",       "width",         "diffuse",   "ambient",    "specular",  "emissive",
    "range",        "constant",     "linear",        "quadratic", "direction",  "intensity", "falloff",
    "transparency", "inner_angle",  "outer_angle",   "roughness", "metalness",  "pos",       "min_height",
    "fade_dist",    "latitude_deg", "longitude_deg", "elevation", "heading_deg"};
const std::set<std::string> kPicturesOfTerrain = {"diffuse", "normal"};

bool isOfNumbers(const XMLElement& element) {
  const std::string kind = element.Value();
  const XMLElement* parent = element.Parent()->ToElement();
  const bool of_texture = parent != nullptr && std::string(parent->Value()) == "texture";
  return kOfNumbers.count(kind) == 1 && !(of_texture && kPicturesOfTerrain.count(kind) == 1);
}

/// Whether numbers end in something else, of which libsdformat says nothing: "1,5" is 1, "90deg" 90.
bool hasTail(const std::string& text) {
  std::istringstream words(text);
  double number = 0.0;
  if (!(words >> number)) return false;
  while (words >> number) {
  }
  return !words.eof();
}

/// Of any grey: Gazebo classic writes 0.7, its successor 0.8.
bool isUsualBackground(const XMLElement& background) {
  std::istringstream text(background.GetText() == nullptr ? "" : background.GetText());
  float red = 0.0f, green = 0.0f, blue = 0.0f;
  if (!(text >> red >> green >> blue)) return true;  // libsdformat speaks of what it cannot read
  return std::abs(red - green) < 1e-3f && std::abs(green - blue) < 1e-3f;
}

class Remarks {
 public:
  Remarks(const std::string& file, SceneBuilder& builder) : file_(file), builder_(builder) {}

  void on(XMLElement& element) {
    const std::string kind = element.Value();
    if (kind == "visibility_flags") onFlags(element);
    if (kind == "scene") onScene(element);
    if (kind == "spherical_coordinates") onPlace(element);
  }

 private:
  void onFlags(const XMLElement& element) {
    std::istringstream text(element.GetText() == nullptr ? "" : element.GetText());
    std::uint32_t flags = kEveryCamera;
    if (text >> flags && flags != kEveryCamera)
      builder_.warn("visuals have <visibility_flags>, every camera sees them", placeOf(file_, element));
  }

  void onScene(XMLElement& element) {
    const auto name = [&](const XMLElement& part, const std::string& instead) {
      builder_.warn("elements of <scene> are not rendered", described(part, file_) + ": " + instead);
    };
    for (XMLElement* fog : childrenOf(element, "fog")) {
      const std::string type = childText(*fog, "type");
      if (!type.empty() && type != "none") name(*fog, "fog is a parameter of the weather");
    }
    for (const XMLElement* background : childrenOf(element, "background")) {
      if (element.FirstChildElement("sky") == nullptr && !isUsualBackground(*background))
        name(*background, "the sky is computed");
    }
    for (const XMLElement* shadows : childrenOf(element, "shadows")) {
      if (!shadows->BoolText(true)) name(*shadows, "everything casts shadows");
    }
  }

  /// Worlds are made with zeros. Where the rest is, siteOf() tells.
  void onPlace(XMLElement& element) {
    for (const XMLElement* part : childrenOf(element)) remarkOnNumbers(*part, file_, builder_);
    const double heading = childNumber(element, "heading_deg");
    if (heading != 0.0)
      builder_.warn(
          "worlds have <heading_deg>, which is not taken: here x points east, so that the sun stands on the "
          "wrong side by as much, unless the poses of models and path are turned",
          placeOf(file_, element) + ": " + textOf(heading));
  }

  const std::string& file_;
  SceneBuilder& builder_;
};

}  // namespace

void remarkOnNumbers(const XMLElement& element, const std::string& file, SceneBuilder& builder) {
  if (isOfNumbers(element) && element.GetText() != nullptr && hasTail(element.GetText()))
    builder.warn(
        "numbers end in what is none, and that is passed over (decimals have a point, blanks part numbers)",
        described(element, file) + " is " + element.GetText());
}

void remarkOnSdf(XMLElement& sdf, const std::string& file, SceneBuilder& builder) {
  Remarks remarks(file, builder);
  forEachBelow(sdf, [&](XMLElement& element) { remarks.on(element); });
}

}  // namespace sunlit::scene
