/// What Assimp is given of a glTF file.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace sunlit::scene {

/// Throws std::runtime_error that says what to do about a file of another version than 2.
void requireGltf2(const nlohmann::json& root, const std::string& file);

/// Whether it gives textures pictures of formats that glTF itself does not have.
bool isOfPictures(const std::string& extension);

/// Opens the files of a glTF file such that Assimp 5.2 may read them: those whose addresses are written with
/// escapes (RFC 3986), and skins without matrices of their own, which it does not expect, with those that
/// section 3.7.3.1 gives them, and joints with names of their own; views and primitives unpacked; attributes
/// as floats; a node for each place of a mesh; textures of WebP, and those of extensions where there are no
/// others; and without animations.
class GltfInput : public Assimp::DefaultIOSystem {
 public:
  /// `root` is that of `file`, or, `mended`, what is to be read in its place. Throws std::runtime_error that
  /// names it.
  GltfInput(const std::string& file, nlohmann::json root, bool mended);

  /// How many meshes that a node shows at many places had quaternions that were not of length 1: now they
  /// are.
  std::size_t turnedOfInstances() const { return turned_of_instances_; }

  bool Exists(const char* path) const override;
  Assimp::IOStream* Open(const char* path, const char* mode = "rb") override;

 private:
  /// Null for files.
  const std::string* madeAt(const std::string& path) const;

  std::string file_;
  std::size_t turned_of_instances_ = 0;
  std::string mended_;                       ///< instead of the file's bytes; empty: nothing to mend
  std::map<std::string, std::string> made_;  ///< buffers, by their addresses
};

}  // namespace sunlit::scene
