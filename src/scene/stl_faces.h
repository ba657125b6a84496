/// Binary STL that is not as long as its number of faces asks for.
#pragma once

#include <string>

namespace sunlit::scene {

/// The bytes of `file` up to its last face, where others stand behind that: programs write there what they
/// like, and Assimp takes such a file for no STL. Empty where there are none, or where it is of text. Throws
/// std::runtime_error naming the file if it is cut short.
std::string countedFacesOfStl(const std::string& file);

}  // namespace sunlit::scene
