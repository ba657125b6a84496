#include "sunlit/image/file_bytes.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace sunlit::image {
namespace {

/// File systems whose bytes lie on this machine, as linux/magic.h numbers them. Elsewhere what was mapped may
/// become unreadable, which ends a process by SIGBUS.
bool isLocal(int descriptor) {
  constexpr std::array<std::uint32_t, 8> kLocal = {
      0x0000EF53,  // ext2, ext3, ext4
      0x58465342,  // XFS
      0x9123683E,  // Btrfs
      0xF2F52010,  // F2FS
      0x2FC12FC1,  // ZFS
      0xCA451A4E,  // bcachefs
      0x01021994,  // tmpfs
      0x794C7630,  // overlay, as in containers
  };
  struct statfs system {};
  if (::fstatfs(descriptor, &system) != 0) return false;
  const auto type = static_cast<std::uint32_t>(system.f_type);
  return std::find(kLocal.begin(), kLocal.end(), type) != kLocal.end();
}

/// Memory of whole pages; null: there is none.
void* mapped(std::size_t size, int protection, int flags, int descriptor) {
  void* const address = ::mmap(nullptr, size, protection, flags, descriptor, 0);
  return address == MAP_FAILED ? nullptr : address;
}

/// False: `errno` says why; 0: the file ended before.
bool readAll(int descriptor, std::byte* to, std::size_t size) {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t read = ::read(descriptor, to + done, size - done);
    if (read < 0 && errno == EINTR) continue;
    if (read == 0) errno = 0;
    if (read <= 0) return false;
    done += static_cast<std::size_t>(read);
  }
  return true;
}

/// An open file.
class Descriptor {
 public:
  explicit Descriptor(const std::string& path)
      : path_(path), number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (number_ < 0) fail("open");
  }
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  [[noreturn]] void fail(const char* what) const {
    const char* const why = errno == 0 ? "it was shortened meanwhile" : std::strerror(errno);
    throw std::runtime_error(path_ + ": " + what + ": " + why);
  }

 private:
  const std::string& path_;
  int number_;
};

}  // namespace

FileBytes::FileBytes(const std::string& path) {
  const Descriptor file(path);
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) file.fail("read");
  if (!S_ISREG(status.st_mode)) {
    errno = S_ISDIR(status.st_mode) ? EISDIR : EINVAL;
    file.fail("read");
  }
  size_ = static_cast<std::size_t>(status.st_size);
  if (size_ == 0) return;
  if (isLocal(file.number())) {
    data_ = mapped(size_, PROT_READ, MAP_SHARED, file.number());
    mapped_ = data_ != nullptr;
    if (mapped_) return;
  }
  data_ = mapped(size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1);
  if (data_ == nullptr) file.fail("read");
  if (readAll(file.number(), static_cast<std::byte*>(data_), size_)) return;
  const int error = errno;
  ::munmap(data_, size_);
  errno = error;
  file.fail("read");
}

void FileBytes::letGo(const void* first, std::size_t size) const {
  if (!mapped_) return;  // of what was read there is nothing else
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const auto from = reinterpret_cast<std::uintptr_t>(first);
  const std::uintptr_t begin = (from + page - 1) / page * page, end = (from + size) / page * page;
  if (begin < end) static_cast<void>(::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_DONTNEED));
}

FileBytes::~FileBytes() {
  if (data_ != nullptr) ::munmap(data_, size_);
}

}  // namespace sunlit::image
