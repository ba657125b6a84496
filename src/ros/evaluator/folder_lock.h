/// Keeps two evaluations from writing into one folder at the same time.
#pragma once

#include <string>

namespace sunlit::ros_interface {

/// Held for as long as it lives; the kernel drops it with the process, however that ends.
class FolderLock {
 public:
  /// Makes the folder where there is none. Throws std::runtime_error naming it where another process holds
  /// it. A folder that cannot be made or opened is left to the one that writes there: it says so better.
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  /// Throws std::runtime_error where the folder was removed, moved or replaced meanwhile: what is written
  /// since then is lost, or stands elsewhere.
  void requireInPlace() const;
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::string folder_;
  int descriptor_ = -1;  // -1: not known
};

}  // namespace sunlit::ros_interface
