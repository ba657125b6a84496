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
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace sunlit::ros_interface
