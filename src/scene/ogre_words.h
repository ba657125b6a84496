/// OGRE's material scripts, word by word.
#pragma once

#include <string>
#include <vector>

namespace sunlit::scene {

using ScriptWords = std::vector<std::string>;

/// Words, braces and, where something may have a parent, colons of a script, a line at a time: without
/// comments and quotes, and with values of variables (`set $name value`) in place of these.
std::vector<ScriptWords> linesOfScript(const std::string& text);

}  // namespace sunlit::scene
