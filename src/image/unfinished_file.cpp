#include "sunlit/image/unfinished_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <stdexcept>
#include <string>
#include <utility>

#include "sunlit/image/files.h"

namespace sunlit::image {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* what) {
  throw std::runtime_error(path.string() + ": " + what + ": " + reasonOf(errno));
}

/// Tells removeUnfinished() of any process that somebody writes to this file, unless its file system has no
/// locks; false if one was there before, and takes it away.
bool isLocked(int descriptor) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
  struct stat found;
  return ::fstat(descriptor, &found) != 0 || found.st_nlink > 0;
}

}  // namespace

UnfinishedFile::UnfinishedFile(std::filesystem::path place, const std::string& kind)
    : place_(std::move(place)) {
  static std::atomic<unsigned> count{0};  // two threads may write the same file
  do {  // beside what one of the same number has left: in containers all begin with the same numbers
    if (descriptor_ >= 0) ::close(descriptor_);
    path_ =
        place_.string() + "." + std::to_string(::getpid()) + "." + std::to_string(count++) + kEnding + kind;
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST) fail(place_, "create");
  } while (descriptor_ < 0 || !isLocked(descriptor_));
}

UnfinishedFile::~UnfinishedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!kept_) ::unlink(path_.c_str());
}

void UnfinishedFile::write(const void* data, std::size_t size) {
  const char* const bytes = static_cast<const char*>(data);
  std::size_t done = 0;
  while (done < size) {
    const ssize_t written = ::write(descriptor_, bytes + done, size - done);
    if (written < 0 && errno != EINTR) fail(place_, "write");
    done += written > 0 ? static_cast<std::size_t>(written) : 0;
  }
  size_ += size;
}

void UnfinishedFile::keep() {
  moveIntoPlace(path_.string(), place_.string());  // locked until it has its name
  kept_ = true;
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(place_, "close");
}

}  // namespace sunlit::image
