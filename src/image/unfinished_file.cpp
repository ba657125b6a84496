#include "sunlit/image/unfinished_file.h"

#include <fcntl.h>
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

}  // namespace

UnfinishedFile::UnfinishedFile(std::filesystem::path place) : place_(std::move(place)) {
  static std::atomic<unsigned> count{0};  // two threads may write the same file
  do {  // beside what one of the same number has left: in containers all begin with the same numbers
    path_ = place_.string() + "." + std::to_string(::getpid()) + "." + std::to_string(count++) + kEnding;
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) fail(place_, "create");
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
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(place_, "close");
  moveIntoPlace(path_.string(), place_.string());
  kept_ = true;
}

}  // namespace sunlit::image
