#include "light/transport/cache_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <regex>
#include <set>
#include <stdexcept>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "sunlit/light/transport.h"

namespace sunlit::light {
namespace {

namespace fs = std::filesystem;
using Log = std::function<void(const std::string&)>;

enum class Patience { kWait, kLeave };

bool lock(int descriptor, int how) {
  while (flock(descriptor, how) != 0) {
    if (errno != EINTR) return false;
  }
  return true;
}

/// Who held the lock before us may have removed its file, and others meet at a new one by now.
bool isStillThere(const fs::path& file, int descriptor) {
  struct stat by_name, by_descriptor;
  return stat(file.c_str(), &by_name) == 0 && fstat(descriptor, &by_descriptor) == 0 &&
         by_name.st_ino == by_descriptor.st_ino && by_name.st_dev == by_descriptor.st_dev;
}

/// A descriptor that holds the lock, or −1 with errno.
int lockedFile(const fs::path& file, Patience patience) {
  while (true) {
    const int descriptor = open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
    if (descriptor < 0) return -1;
    if (lock(descriptor, patience == Patience::kWait ? LOCK_EX : LOCK_EX | LOCK_NB)) {
      if (isStillThere(file, descriptor)) return descriptor;
      close(descriptor);
      continue;
    }
    const int why = errno;
    close(descriptor);
    errno = why;
    return -1;
  }
}

fs::path turnFile(const fs::path& bake) {
  return bake.string() + ".lock";
}

bool isInUse(const fs::path& bake) {
  const int descriptor = open(bake.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool free = lock(descriptor, LOCK_EX | LOCK_NB);
  close(descriptor);
  return !free;
}

struct KeptBake {
  fs::file_time_type used;
  fs::path file;
  std::uintmax_t bytes;
  bool operator<(const KeptBake& other) const {
    return std::tie(used, file) < std::tie(other.used, other.file);
  }
};

struct CacheContent {
  std::vector<KeptBake> bakes;
  std::vector<fs::path> unfinished;
  std::set<fs::path> claimed;  ///< bakes that somebody makes, or died over
};

CacheContent contentOf(const fs::path& folder) {
  static const std::regex name(R"(([0-9a-f]{32}\.light)(\.lock|\.[0-9]+\.part)?)");
  CacheContent content;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::smatch parts;
    const std::string text = entry->path().filename().string();
    if (!std::regex_match(text, parts, name)) continue;
    if (!parts[2].matched) {
      std::error_code gone;  // removed by another process just now
      const KeptBake bake{entry->last_write_time(gone), entry->path(), entry->file_size(gone)};
      if (!gone) content.bakes.push_back(bake);
      continue;
    }
    if (parts[2] != ".lock") content.unfinished.push_back(entry->path());
    content.claimed.insert(folder / parts[1].str());
  }
  return content;
}

void removeFile(const fs::path& file, const Log& log) {
  std::error_code error;
  fs::remove(file, error);
  if (error && log) log(file.string() + ": cannot be removed: " + error.message());
}

}  // namespace

std::uintmax_t BakeCache::usedBytes() const {
  std::uintmax_t sum = 0;
  for (const KeptBake& bake : contentOf(folder).bakes) sum += bake.bytes;
  return sum;
}

BakeTurn BakeTurn::await(const fs::path& bake) {
  const fs::path file = turnFile(bake);
  const int descriptor = lockedFile(file, Patience::kWait);
  if (descriptor < 0) throw std::runtime_error(file.string() + ": " + std::strerror(errno));
  return BakeTurn(file, descriptor);
}

std::optional<BakeTurn> BakeTurn::ifFree(const fs::path& bake) {
  const fs::path file = turnFile(bake);
  const int descriptor = lockedFile(file, Patience::kLeave);
  if (descriptor < 0) return std::nullopt;
  return BakeTurn(file, descriptor);
}

BakeTurn::BakeTurn(BakeTurn&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

BakeTurn& BakeTurn::operator=(BakeTurn&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

BakeTurn::~BakeTurn() {
  if (descriptor_ < 0) return;
  unlink(file_.c_str());
  close(descriptor_);
}

BakeInUse::BakeInUse(const fs::path& bake) : descriptor_(open(bake.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ < 0) return;
  lock(descriptor_, LOCK_SH);
  futimens(descriptor_, nullptr);  // in a folder that is only read, its order of use stays as it is
}

BakeInUse::~BakeInUse() {
  if (descriptor_ >= 0) close(descriptor_);
}

void tidyCache(const fs::path& folder, std::uintmax_t limit_bytes, const Log& log) {
  CacheContent content = contentOf(folder);
  for (const fs::path& bake : content.claimed) {
    const std::optional<BakeTurn> turn = BakeTurn::ifFree(bake);
    if (!turn) continue;
    for (const fs::path& file : content.unfinished) {
      if (file.string().rfind(bake.string(), 0) == 0) removeFile(file, log);
    }
  }
  std::sort(content.bakes.begin(), content.bakes.end());
  std::uintmax_t bytes = 0;
  for (const KeptBake& bake : content.bakes) bytes += bake.bytes;
  for (const KeptBake& bake : content.bakes) {
    if (bytes <= limit_bytes) return;
    if (isInUse(bake.file)) continue;
    removeFile(bake.file, log);
    bytes -= bake.bytes;
  }
}

}  // namespace sunlit::light
