#include "scene/robot/urdf_text.h"

#include <console_bridge/console.h>
#include <tinyxml.h>
#include <tinyxml2.h>
#include <urdf_parser/urdf_parser.h>

#include <stdexcept>

#include "sunlit/quantity/one_line.h"

namespace sunlit::scene {
namespace {

/// Keeps what urdfdom would print, for as long as it lives.
class Listener : public console_bridge::OutputHandler {
 public:
  Listener() { console_bridge::useOutputHandler(this); }
  ~Listener() override { console_bridge::restorePreviousOutputHandler(); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) {
      errors.push_back(text);
    } else if (level >= console_bridge::CONSOLE_BRIDGE_LOG_WARN) {
      warnings.push_back(text);
    }
  }

  std::vector<std::string> errors, warnings;
};

/// What nobody sees is not to stop anything: urdfdom refuses a link for an inertia that lacks a number, and
/// for shapes of collisions that other programs know.
void dropUnseen(TiXmlElement* robot) {
  for (TiXmlElement* link = robot->FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    for (const char* unseen : {"inertial", "collision"})
      while (TiXmlElement* element = link->FirstChildElement(unseen)) link->RemoveChild(element);
  }
}

/// The first of `element` and those below it whose name is as wanted; null where there is none.
const TiXmlElement* firstIn(const TiXmlElement& element, bool (*wanted)(const std::string& name)) {
  if (wanted(element.Value())) return &element;
  for (const TiXmlElement* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    if (const TiXmlElement* const found = firstIn(*child, wanted)) return found;
  }
  return nullptr;
}

/// Of links, whether or not they may have a shape; other programs have elements of their own, with a prefix.
bool isKnownInLinks(const std::string& name) {
  return name == "visual" || name == "inertial" || name == "sensor" ||
         name.find("collision") != std::string::npos || name.find(':') != std::string::npos;
}

}  // namespace

UrdfText::UrdfText(const std::string& text, const std::string& origin) : origin_(origin) {
  const std::string seen = read(text);
  Listener listener;
  try {
    model_ = urdf::parseURDF(seen);
  } catch (const std::exception& error) {  // of a number, say
    listener.errors.emplace_back(error.what());
  }
  // Some errors urdfdom passes over, and drops the link's visuals without another word.
  if (!model_ || !listener.errors.empty()) fail(listener.errors);
  oddities_ = listener.warnings;
}

std::string UrdfText::read(const std::string& text) {
  // TinyXML, which urdfdom uses, calls itself for each level, until the stack ends.
  tinyxml2::XMLDocument levels;
  if (levels.Parse(text.data(), text.size()) == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED) {
    throw std::runtime_error(origin_ + ":" + std::to_string(levels.ErrorLineNum()) +
                             ": elements lie within each other on too many levels");
  }
  TiXmlDocument document;
  document.Parse(text.c_str(), nullptr, TIXML_ENCODING_UTF8);
  if (document.Error()) {
    throw std::runtime_error(origin_ + ":" + std::to_string(document.ErrorRow()) +
                             ": the XML is broken here (" + document.ErrorDesc() + ")");
  }
  TiXmlElement* const robot = document.FirstChildElement("robot");
  if (robot == nullptr) throw std::runtime_error(origin_ + ":1: there is no <robot> element in this text");
  requireNoMacros(*robot);
  for (const TiXmlElement* element = robot->FirstChildElement(); element != nullptr;
       element = element->NextSiblingElement()) {
    const std::string kind = element->Value();
    if (kind == "link") noteUnknown(*element);
    const char* name = element->Attribute("name");
    if (name == nullptr) continue;
    lines_.emplace(std::make_pair(kind, std::string(name)), element->Row());
    if (kind == "link") links_.emplace_back(name);
  }
  dropUnseen(robot);
  TiXmlPrinter printer;
  document.Accept(&printer);
  return printer.Str();
}

std::string UrdfText::lineOf(const TiXmlElement& element) const {
  return origin_ + ":" + std::to_string(element.Row());
}

void UrdfText::requireNoMacros(const TiXmlElement& robot) const {
  const auto is_macro = [](const std::string& name) { return name.rfind("xacro:", 0) == 0; };
  if (const TiXmlElement* const macro = firstIn(robot, is_macro)) {
    throw std::runtime_error(lineOf(*macro) + ": <" + macro->Value() +
                             "> is a macro; turn this text into a URDF first, by xacro");
  }
}

void UrdfText::noteUnknown(const TiXmlElement& link) {
  const auto is_shape = [](const std::string& name) { return name == "geometry"; };
  for (const TiXmlElement* element = link.FirstChildElement(); element != nullptr;
       element = element->NextSiblingElement()) {
    if (!isKnownInLinks(element->Value()) && firstIn(*element, is_shape) != nullptr)
      unknown_.push_back("<" + element->ValueStr() + "> of " + lineOf(*element));
  }
}

std::string UrdfText::place(const std::string& kind, const std::string& name) const {
  const auto line = lines_.find({kind, name});
  return origin_ + (line == lines_.end() ? "" : ":" + std::to_string(line->second)) + ": " + kind + " " +
         name;
}

/// The first complaint is the cause, later ones are its consequences and say where it is.
void UrdfText::fail(const std::vector<std::string>& complaints) const {
  std::string text;
  int line = 0;
  for (const std::string& complaint : complaints) {
    text += (text.empty() ? "" : "; ") + oneLine(complaint);
    for (const auto& [what, row] : lines_) {
      for (const auto& [open, close] : {std::pair{'[', ']'}, {'\'', '\''}, {'"', '"'}}) {
        if (line == 0 && complaint.find(open + what.second + close) != std::string::npos) line = row;
      }
    }
  }
  throw std::runtime_error(origin_ + (line > 0 ? ":" + std::to_string(line) : "") +
                           ": this is no URDF: " + (text.empty() ? "its parser gives no reason" : text));
}

}  // namespace sunlit::scene
