#include "ros/evaluator/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>

namespace sunlit::ros_interface {

FolderLock::FolderLock(const std::string& folder) : folder_(folder) {
  std::error_code ignored;
  std::filesystem::create_directories(folder, ignored);
  descriptor_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0 || flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  // Some network file systems know no locks: then there is none.
  if (errno != EWOULDBLOCK) return;
  close(descriptor_);
  throw std::runtime_error(folder + ": another evaluation is writing into this folder");
}

void FolderLock::requireInPlace() const {
  struct stat held = {};
  struct stat there = {};
  if (descriptor_ < 0 || fstat(descriptor_, &held) != 0) return;
  const bool is_there = stat(folder_.c_str(), &there) == 0;
  if (!is_there && errno != ENOENT) return;  // such as a network that does not answer for a while
  if (is_there && there.st_dev == held.st_dev && there.st_ino == held.st_ino) return;
  throw std::runtime_error(folder_ + ": this folder was removed, moved or replaced while results were " +
                           "written into it; start the run again");
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace sunlit::ros_interface
