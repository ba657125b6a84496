#include "scene/sdf_schema.h"

#include <memory>
#include <sdf/Element.hh>
#include <sdf/parser.hh>
#include <string>

#include "scene/sdf_mend.h"

namespace sunlit::scene {
namespace {

/// Levels of models within models that have it, too: of deeper ones the library reads its whole schema.
constexpr int kNested = 1;

const sdf::Element& wholeSchema() {
  static const sdf::SDFPtr schema = [] {
    auto made = std::make_shared<sdf::SDF>();
    sdf::init(made);
    return made;
  }();
  return *schema->Root();
}

/// An element's name, attributes and how often it may stand.
sdf::ElementPtr withoutChildren(const sdf::Element& element) {
  auto made = std::make_shared<sdf::Element>();
  made->SetName(element.GetName());
  made->SetRequired(element.GetRequired());
  made->SetCopyChildren(element.GetCopyChildren());
  for (unsigned i = 0; i < element.GetAttributeCount(); ++i) {
    const sdf::ParamPtr attribute = element.GetAttribute(i);
    made->AddAttribute(attribute->GetKey(), attribute->GetTypeName(), attribute->GetDefaultAsString(),
                       attribute->GetRequired());
  }
  return made;
}

/// `element` with what may be drawn of it, as deep as mendSdf() takes things out. `within`: so many models.
sdf::ElementPtr drawnOf(const sdf::Element& element, int within = 0) {
  if (!isMendedWithin(element.GetName())) return element.Clone();
  sdf::ElementPtr made = withoutChildren(element);
  for (unsigned i = 0; i < element.GetElementDescriptionCount(); ++i) {
    const sdf::ElementPtr child = element.GetElementDescription(i);
    if (!mayRemain(element.GetName(), child->GetName())) continue;
    if (child->ReferenceSDF().empty()) {
      made->AddElementDescription(drawnOf(*child, within));
    } else if (child->GetName() == element.GetName() && within < kNested) {
      const sdf::ElementPtr nested = drawnOf(element, within + 1);
      nested->SetRequired(child->GetRequired());
      made->AddElementDescription(nested);
    } else {
      made->AddElementDescription(child->Clone());
    }
  }
  return made;
}

sdf::SDFPtr emptyOf(const sdf::Element& schema) {
  auto made = std::make_shared<sdf::SDF>();
  made->Root(schema.Clone());
  return made;
}

}  // namespace

sdf::SDFPtr emptySdf() {
  return emptyOf(wholeSchema());
}

sdf::SDFPtr emptySdfFor(const tinyxml2::XMLDocument& document) {
  static const sdf::ElementPtr drawn = drawnOf(wholeSchema());
  return isOfKnownChildren(*document.FirstChildElement("sdf")) ? emptyOf(*drawn) : emptySdf();
}

}  // namespace sunlit::scene
