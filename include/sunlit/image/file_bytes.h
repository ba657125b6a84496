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

  /// Takes `size` bytes from `first` on, as far as they fill pages of their own, out of this process' memory
  /// if they are mapped: whoever looks at them has them back, mostly at once from what the system still
  /// keeps.
  void letGo(const void* first, std::size_t size) const;

 private:
  void* data_ = nullptr;
  bool mapped_ = false;  ///< or read
  std::size_t size_ = 0;
};

}  // namespace sunlit::image
