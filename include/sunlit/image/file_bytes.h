/// The bytes of a large file, without a copy of them where that is safe.
#pragma once

#include <cstddef>
#include <string>

namespace sunlit::image {

/// What a file held when it was opened. On a disk of this machine it is mapped: processes that open the same
/// file share its memory, of which the system keeps what is used. The file may then be replaced or removed,
/// but whoever shortens it or writes into it changes these bytes, too. On any other file system, whose server
/// may take a file away, the bytes are read.
class FileBytes {
 public:
  /// Throws std::runtime_error "path: what failed: why".
  explicit FileBytes(const std::string& path);
  ~FileBytes();
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;

  /// Begins at a page, and so is aligned for every type.
  const std::byte* data() const { return static_cast<const std::byte*>(data_); }
  std::size_t size() const { return size_; }

 private:
  void* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace sunlit::image
