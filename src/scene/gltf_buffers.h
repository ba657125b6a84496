/// The buffers of a glTF file.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace sunlit::scene {

/// Reads each once, when it is first asked for, and keeps those that are made here, whose addresses are of no
/// file.
class GltfBuffers {
 public:
  /// `root` is the JSON of `file`. Keeps references.
  GltfBuffers(nlohmann::json& root, const std::string& file) : root_(root), file_(file) {}

  /// image::requireContent() of each file. Assimp may pass over what its input throws.
  void requireContents() const;
  /// From a file beside it, from a data address, or from the second chunk of a .glb; or as it was made.
  /// Throws std::runtime_error that says what is not there.
  const std::string& bytes(std::size_t buffer);
  /// A further buffer in `root`: its index.
  std::size_t add(std::string bytes);
  /// Gives one of `root` other bytes.
  void make(std::size_t buffer, std::string bytes);
  /// Those made, by their addresses. May be taken once.
  std::map<std::string, std::string> takeMade();

 private:
  std::string read(std::size_t buffer) const;
  std::string pathOf(const std::string& uri) const;

  nlohmann::json& root_;
  const std::string& file_;
  std::map<std::size_t, std::string> read_;
  std::map<std::size_t, std::string> made_;
};

}  // namespace sunlit::scene
