#include "sunlit/image/cache_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <regex>
#include <set>
#include <system_error>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "sunlit/quantity/memory.h"

namespace sunlit::image {
namespace {

namespace fs = std::filesystem;
using Log = std::function<void(const std::string&)>;

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

/// A descriptor that holds the lock, or −1 with errno, EWOULDBLOCK where another holds it.
int lockedFile(const fs::path& file) {
  while (true) {
    const int descriptor = open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
    if (descriptor < 0) return -1;
    if (lock(descriptor, LOCK_EX | LOCK_NB)) {
      if (isStillThere(file, descriptor)) {
        // How far somebody was who died with it is past. That it can't be removed is no error.
        [[maybe_unused]] const int emptied = ftruncate(descriptor, 0);
        return descriptor;
      }
      close(descriptor);
      continue;
    }
    const int why = errno;
    close(descriptor);
    errno = why;
    return -1;
  }
}

/// Of a fixed length, so that each hides the one before.
constexpr const char* kProgressFormat = "%.6f %15.3f\n";
using ProgressText = std::array<char, 32>;

CacheProgress toldIn(const fs::path& turn_file) {
  ProgressText text{};
  CacheProgress told;
  const int descriptor = open(turn_file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return told;
  const bool has_any = read(descriptor, text.data(), text.size() - 1) > 0;
  close(descriptor);
  CacheProgress read;
  if (has_any && std::sscanf(text.data(), "%lf %lf", &read.share, &read.seconds_left) == 2) told = read;
  return told;
}

fs::path turnFile(const fs::path& kept) {
  return kept.string() + ".lock";
}

bool isInUse(const fs::path& kept) {
  const int descriptor = open(kept.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool free = lock(descriptor, LOCK_EX | LOCK_NB);
  close(descriptor);
  return !free;
}

struct KeptFile {
  fs::file_time_type used;
  fs::path file;
  std::uintmax_t bytes;
  bool operator<(const KeptFile& other) const {
    return std::tie(used, file) < std::tie(other.used, other.file);
  }
};

struct CacheContent {
  std::vector<KeptFile> kept;
  std::vector<fs::path> unfinished;
  std::set<fs::path> claimed;  ///< what somebody makes, or died over
};

CacheContent contentOf(const CacheFolder& cache) {
  const std::regex name("([0-9a-f]{32}\\" + cache.ending + R"()(\.lock|(\.[0-9]+){1,2}\.part)?)");
  CacheContent content;
  std::error_code error;
  for (fs::directory_iterator entry(cache.path, error), end; !error && entry != end; entry.increment(error)) {
    std::smatch parts;
    const std::string text = entry->path().filename().string();
    if (!std::regex_match(text, parts, name)) continue;
    if (!parts[2].matched) {
      std::error_code gone;  // removed by another process just now
      const KeptFile kept{entry->last_write_time(gone), entry->path(), entry->file_size(gone)};
      if (!gone) content.kept.push_back(kept);
      continue;
    }
    if (parts[2] != ".lock") content.unfinished.push_back(entry->path());
    content.claimed.insert(cache.path / parts[1].str());
  }
  return content;
}

std::uintmax_t bytesOf(const CacheContent& content) {
  std::uintmax_t sum = 0;
  for (const KeptFile& file : content.kept) sum += file.bytes;
  return sum;
}

void removeFile(const fs::path& file, const Log& log) {
  std::error_code error;
  fs::remove(file, error);
  if (error && log) log(file.string() + ": cannot be removed: " + error.message());
}

}  // namespace

std::string usualCacheFolder() {
  const auto value = [](const char* name) {
    return std::getenv(name) ? std::string(std::getenv(name)) : std::string();
  };
  if (!value("SUNLIT_CACHE_DIR").empty()) return value("SUNLIT_CACHE_DIR");
  if (!value("XDG_CACHE_HOME").empty()) return fs::path(value("XDG_CACHE_HOME")) / "sunlit";
  if (!value("HOME").empty()) return fs::path(value("HOME")) / ".cache" / "sunlit";
  return fs::temp_directory_path() / "sunlit";
}

CacheTurn CacheTurn::await(const fs::path& kept, const Waits& waits) {
  const fs::path file = turnFile(kept);
  constexpr std::chrono::milliseconds kGlance(50);
  int descriptor = lockedFile(file);
  while (descriptor < 0 && errno == EWOULDBLOCK) {
    if (waits) waits(toldIn(file));
    std::this_thread::sleep_for(kGlance);
    descriptor = lockedFile(file);
  }
  if (descriptor < 0) throw std::system_error(errno, std::generic_category(), file.string());
  return CacheTurn(file, descriptor);
}

std::optional<CacheTurn> CacheTurn::ifFree(const fs::path& kept) {
  const fs::path file = turnFile(kept);
  const int descriptor = lockedFile(file);
  if (descriptor < 0) return std::nullopt;
  return CacheTurn(file, descriptor);
}

CacheTurn::CacheTurn(CacheTurn&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

CacheTurn& CacheTurn::operator=(CacheTurn&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

CacheTurn::~CacheTurn() {
  if (descriptor_ < 0) return;
  unlink(file_.c_str());
  close(descriptor_);
}

void CacheTurn::tell(const CacheProgress& progress) const {
  ProgressText text;
  const int length =
      std::snprintf(text.data(), text.size(), kProgressFormat, progress.share, progress.seconds_left);
  if (length <= 0 || static_cast<std::size_t>(length) >= text.size()) return;
  [[maybe_unused]] const ssize_t written =
      pwrite(descriptor_, text.data(), static_cast<std::size_t>(length), 0);
}

CacheUse::CacheUse(const fs::path& kept) : descriptor_(open(kept.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ < 0) return;
  lock(descriptor_, LOCK_SH);
  futimens(descriptor_, nullptr);  // in a folder that is only read, its order of use stays as it is
}

CacheUse::~CacheUse() {
  if (descriptor_ >= 0) close(descriptor_);
}

std::string notKeptText(const std::string& what, const std::exception& problem) {
  const auto* of_file = dynamic_cast<const fs::filesystem_error*>(&problem);
  return what + " not kept: " +
         (of_file ? of_file->path1().string() + ": " + of_file->code().message() : reasonInWords(problem)) +
         "; SUNLIT_CACHE_DIR (of tools, --cache DIR) names another folder";
}

std::uintmax_t CacheFolder::usedBytes() const {
  return bytesOf(contentOf(*this));
}

std::uintmax_t CacheFolder::tidy(std::uintmax_t limit_bytes, const Log& log, fs::file_time_type since) const {
  CacheContent content = contentOf(*this);
  for (const fs::path& claimed : content.claimed) {
    const std::optional<CacheTurn> turn = CacheTurn::ifFree(claimed);
    if (!turn) continue;
    for (const fs::path& file : content.unfinished) {
      if (file.string().rfind(claimed.string(), 0) == 0) removeFile(file, log);
    }
  }
  std::sort(content.kept.begin(), content.kept.end());
  std::uintmax_t bytes = bytesOf(content);
  for (const KeptFile& kept : content.kept) {
    if (bytes <= limit_bytes || kept.used >= since) break;
    if (isInUse(kept.file)) continue;
    removeFile(kept.file, log);
    bytes -= kept.bytes;
  }
  return bytes;
}

}  // namespace sunlit::image
