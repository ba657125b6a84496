#include "scene/obj_input.h"

#include <cctype>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "scene/mesh_file.h"

namespace sunlit::scene {
namespace {

/// Lines end as Assimp has it, and one that begins with a blank or a # is none.
void requireMaterialFirst(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const std::string ends("\n\r\f\0", 4);
  std::size_t line = 1;
  for (std::size_t at = 0; at < text.size(); ++line) {
    if (std::isalpha(static_cast<unsigned char>(text[at])) != 0) {
      if (text.compare(at, 6, "newmtl") == 0) return;
      throw std::runtime_error(path + ":" + std::to_string(line) + ": '" +
                               text.substr(at, text.find_first_of(" \t" + ends, at) - at) +
                               "' stands before the first newmtl, and is of no material");
    }
    at = text.find_first_of(ends, at);
    if (at != std::string::npos) ++at;
  }
}

}  // namespace

Assimp::IOStream* ObjInput::Open(const char* path, const char* mode) {
  if (extensionOf(path) != ".obj" && Exists(path)) requireMaterialFirst(path);
  return DefaultIOSystem::Open(path, mode);
}

}  // namespace sunlit::scene
