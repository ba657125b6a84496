/// The two chunks of a binary glTF file.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sunlit::scene {

/// Numbers and pictures one behind the other, each in a buffer view of its own.
class GlbBuffer {
 public:
  /// Index of the new buffer view.
  std::size_t add(const void* data, std::size_t size);

  /// The entries of "bufferViews".
  const std::vector<std::string>& views() const { return views_; }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  std::vector<std::string> views_;
};

/// `text` as a JSON string, quotes included. What is no UTF-8, which JSON has to be (RFC 8259, section 8.1),
/// becomes U+FFFD.
std::string jsonString(const std::string& text);

/// `items` as a JSON array.
std::string jsonArray(const std::vector<std::string>& items);

/// The header of a binary glTF file and its JSON, before other chunks of `size` bytes together, with their
/// own headers. Throws std::length_error if all would be larger than the format can hold.
std::string glbStart(std::string json, std::size_t size);

/// The whole file. Throws std::length_error if it would be larger than the format can hold.
std::string glbFile(std::string json, const GlbBuffer& buffer);

}  // namespace sunlit::scene
