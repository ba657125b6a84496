#include "scene/sdf_remarks.h"

#include <cmath>
#include <cstdint>
#include <sstream>

#include "scene/sdf_xml.h"
#include "sunlit/quantity/range.h"

namespace sunlit::scene {
namespace {

using tinyxml2::XMLElement;

/// The flags of a visual that has none.
constexpr std::uint32_t kEveryCamera = 0xFFFFFFFF;

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
  void onPlace(const XMLElement& element) {
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

void remarkOnSdf(XMLElement& sdf, const std::string& file, SceneBuilder& builder) {
  Remarks remarks(file, builder);
  forEachBelow(sdf, [&](XMLElement& element) { remarks.on(element); });
}

}  // namespace sunlit::scene
