/// The JSON of glTF files.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace sunlit::scene {

/// Name of the extension of primitives that Draco packs.
constexpr const char* kDraco = "KHR_draco_mesh_compression";

/// All of a file. Throws std::runtime_error naming it if it cannot be read.
std::string bytesOf(const std::string& file);
/// The JSON of a glTF file, and what stands behind it: nothing in a .gltf.
struct GltfParts {
  std::string json;
  std::string rest;     ///< the other chunks, each of 4 bytes for its length, 4 for its type, and its content
  bool binary = false;  ///< a .glb, whatever its name
  bool marked = false;  ///< a byte order mark stood before it, as one may (glTF 2.0, section 3.2)
};
/// Throws as bytesOf().
GltfParts gltfParts(const std::string& file);
/// Throws std::runtime_error naming `file`.
nlohmann::json parseGltf(const std::string& text, const std::string& file);

/// Object or array `key` of `from`; an empty object if there is none.
const nlohmann::json& child(const nlohmann::json& from, const char* key);
/// A number that counts something: converting others, such as 1e308, has no meaning. Throws
/// std::runtime_error with what stands there.
std::size_t indexOf(const nlohmann::json& number);
/// That of `key`; `usual` where there is none.
std::size_t indexOf(const nlohmann::json& from, const char* key, std::size_t usual);
/// How many numbers an element of an accessor has (glTF 2.0, section 3.6.2.3); 1 of what is no type, as
/// Assimp has it.
std::size_t numbersOfElement(const nlohmann::json& accessor);
/// `path`, or, where nothing is there, the file that it names without its escapes (RFC 3986).
std::string meantPath(const std::string& path);
/// What `from` says in the words of an extension; empty if nothing.
const nlohmann::json& extension(const nlohmann::json& from, const char* name);
/// Whether this is a name of the extension of packed views: EXT_meshopt_compression, or Khronos's for it.
bool isPacking(const std::string& name);
/// The name by whose words `from`, a view or a buffer, is packed; null: it is not.
const char* packingOf(const nlohmann::json& from);

}  // namespace sunlit::scene
