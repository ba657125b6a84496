/// Values of XML attributes that lack their quotes.
#pragma once

#include <string>

namespace sunlit::scene {

/// `text` with quotes around values of attributes that have none (`<gui fullscreen=1>`), as TinyXML reads
/// them, and with it Gazebo Classic: up to a blank, '/' or '>'. All else, and each line, stays as it is.
std::string quotedValues(const std::string& text);

}  // namespace sunlit::scene
