/// The buffers of a glTF file.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace sunlit::scene {

/// Reads each once, when it is first asked for.
class GltfBuffers {
 public:
  /// `root` is the JSON of `file`. Keeps references.
  GltfBuffers(const nlohmann::json& root, const std::string& file) : root_(root), file_(file) {}

  /// From a file beside it, from a data address, or from the second chunk of a .glb. Throws
  /// std::runtime_error that says what is not there.
  const std::string& bytes(std::size_t buffer);

 private:
  std::string read(std::size_t buffer) const;

  const nlohmann::json& root_;
  const std::string& file_;
  std::map<std::size_t, std::string> read_;
};

}  // namespace sunlit::scene
