/// SDF files as XML, before libsdformat sees them.
#pragma once

#include <tinyxml2.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace sunlit::scene {

/// The file as it stands, with an <sdf> element, or the <robot> of a URDF. Throws std::runtime_error naming
/// file and line of what is wrong.
std::unique_ptr<tinyxml2::XMLDocument> readSdfXml(const std::string& file);

/// Whether it is a URDF.
bool isUrdf(const tinyxml2::XMLDocument& document);

/// `document` as text in which each element begins on the line that it has in its file, whatever was taken
/// out before it, so that libsdformat's errors name lines of the file. Comments are left out.
std::string printed(const tinyxml2::XMLDocument& document);

/// Empty where there is no such attribute, or child with a text.
std::string attributeOf(const tinyxml2::XMLElement& element, const char* name);
std::string childText(const tinyxml2::XMLElement& element, const char* name);
/// 0 where there is none, or no number in it.
double childNumber(const tinyxml2::XMLElement& element, const char* name);

/// The children at this moment, so that they may be taken out; all, or those of one name.
std::vector<tinyxml2::XMLElement*> childrenOf(tinyxml2::XMLElement& parent, const char* name = nullptr);

/// The first child of this name, which is made if need be.
tinyxml2::XMLElement& childIn(tinyxml2::XMLElement& parent, const char* name);
/// A new one behind the others; tinyxml2's own word for that is only in 8 and newer.
tinyxml2::XMLElement& newChildIn(tinyxml2::XMLElement& parent, const char* name);

/// "<file>:<line>".
std::string placeOf(const std::string& file, const tinyxml2::XMLElement& element);
/// "<<kind>> <name> of <file>:<line>".
std::string described(const tinyxml2::XMLElement& element, const std::string& file);

/// Each element below `parent`, parents first. None may be taken out meanwhile.
void forEachBelow(tinyxml2::XMLElement& parent, const std::function<void(tinyxml2::XMLElement&)>& use);

}  // namespace sunlit::scene
