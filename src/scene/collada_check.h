/// COLLADA files that Assimp may be given.
#pragma once

#include <tinyxml2.h>

#include <memory>
#include <string>

namespace sunlit::scene {

/// Assimp 5.2 trusts that counts, strides and indices of a COLLADA file fit its arrays, that lists of indices
/// hold nothing but digits, and that nodes and parameters do not refer to each other in circles; where they
/// do not, it reads memory that is not its own, or never ends. Throws std::runtime_error with file, line, and
/// what should stand there. `text` is that of `file`; its elements are returned, one at least.
std::unique_ptr<tinyxml2::XMLDocument> checkedCollada(const std::string& text, const std::string& file);

}  // namespace sunlit::scene
