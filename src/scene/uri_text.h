/// Addresses as texts.
#pragma once

#include <string>

namespace sunlit::scene {

std::string lowerCase(std::string text);
/// What stands behind "://", or "file:"; all of it where there is none. Of file://localhost/ the path.
std::string withoutScheme(const std::string& uri);
/// Turns %20 and its like into the characters that they stand for.
std::string withoutEscapes(const std::string& text);

}  // namespace sunlit::scene
