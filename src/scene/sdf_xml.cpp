#include "scene/sdf_xml.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "scene/sdf_quotes.h"
#include "sunlit/image/files.h"
#include "sunlit/quantity/utf8.h"

namespace sunlit::scene {
namespace {

class LineKeeper : public tinyxml2::XMLPrinter {
 public:
  LineKeeper() : XMLPrinter(nullptr, true) {}

  bool VisitEnter(const tinyxml2::XMLElement& element, const tinyxml2::XMLAttribute* attributes) override {
    SealElementIfJustOpened();
    const char* const text = CStr();
    const int size = CStrSize() - 1;  // without the end of the string
    line_ += static_cast<int>(std::count(text + counted_, text + size, '\n'));
    counted_ = size;
    for (; line_ < element.GetLineNum(); ++line_, ++counted_) Putc('\n');
    return XMLPrinter::VisitEnter(element, attributes);
  }
  using XMLPrinter::Visit;
  using XMLPrinter::VisitEnter;
  bool Visit(const tinyxml2::XMLComment&) override { return true; }

 private:
  int line_ = 1;
  int counted_ = 0;  ///< of the text, for its lines
};

/// Takes out an XML declaration that something stands before, such as a comment: Gazebo reads on, tinyxml2
/// does not.
void dropLateDeclaration(std::string* text) {
  const std::size_t begin = text->find("<?xml");
  if (begin == std::string::npos || text->find('<') == begin) return;
  const std::size_t end = text->find("?>", begin);
  if (end != std::string::npos) text->erase(begin, end + 2 - begin);
}

}  // namespace

std::unique_ptr<tinyxml2::XMLDocument> readSdfXml(const std::string& file) {
  image::requireContent(file);
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error(file + ": cannot open this file");
  std::string text = utf8Of({std::istreambuf_iterator<char>(stream), {}}, file);
  dropLateDeclaration(&text);
  auto document = std::make_unique<tinyxml2::XMLDocument>();
  // Gazebo Classic takes values without quotes, tinyxml2 does not.
  if (document->Parse(text.data(), text.size()) == tinyxml2::XML_ERROR_PARSING_ATTRIBUTE) {
    text = quotedValues(text);
    document->Parse(text.data(), text.size());
  }
  if (document->Error()) {
    throw std::runtime_error(file + ":" + std::to_string(document->ErrorLineNum()) +
                             ": the XML is broken here (" + document->ErrorName() + ")");
  }
  if (document->FirstChildElement("sdf") == nullptr && !isUrdf(*document))
    throw std::runtime_error(file + ":1: there is no <sdf> element in this file");
  return document;
}

bool isUrdf(const tinyxml2::XMLDocument& document) {
  const tinyxml2::XMLElement* const root = document.RootElement();
  return root != nullptr && std::string(root->Value()) == "robot";
}

std::string printed(const tinyxml2::XMLDocument& document) {
  LineKeeper printer;
  document.Accept(&printer);
  return printer.CStr();
}

std::string attributeOf(const tinyxml2::XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value == nullptr ? "" : value;
}

std::string childText(const tinyxml2::XMLElement& element, const char* name) {
  const tinyxml2::XMLElement* child = element.FirstChildElement(name);
  const char* text = child == nullptr ? nullptr : child->GetText();
  if (text == nullptr) return "";
  const std::string whole = text;
  const std::size_t begin = whole.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) return "";
  return whole.substr(begin, whole.find_last_not_of(" \t\r\n") + 1 - begin);
}

double childNumber(const tinyxml2::XMLElement& element, const char* name) {
  double number = 0.0;
  std::istringstream(childText(element, name)) >> number;
  return number;
}

std::vector<tinyxml2::XMLElement*> childrenOf(tinyxml2::XMLElement& parent, const char* name) {
  std::vector<tinyxml2::XMLElement*> children;
  for (auto* child = parent.FirstChildElement(name); child != nullptr;
       child = child->NextSiblingElement(name))
    children.push_back(child);
  return children;
}

tinyxml2::XMLElement& childIn(tinyxml2::XMLElement& parent, const char* name) {
  tinyxml2::XMLElement* child = parent.FirstChildElement(name);
  return child != nullptr ? *child : newChildIn(parent, name);
}

tinyxml2::XMLElement& newChildIn(tinyxml2::XMLElement& parent, const char* name) {
  return *parent.InsertEndChild(parent.GetDocument()->NewElement(name))->ToElement();
}

std::string placeOf(const std::string& file, const tinyxml2::XMLElement& element) {
  return file + ":" + std::to_string(element.GetLineNum());
}

std::string described(const tinyxml2::XMLElement& element, const std::string& file) {
  const std::string name = attributeOf(element, "name");
  return std::string("<") + element.Value() + ">" + (name.empty() ? "" : " " + name) + " of " +
         placeOf(file, element);
}

void forEachBelow(tinyxml2::XMLElement& parent, const std::function<void(tinyxml2::XMLElement&)>& use) {
  for (tinyxml2::XMLElement* child : childrenOf(parent)) {
    use(*child);
    forEachBelow(*child, use);
  }
}

}  // namespace sunlit::scene
