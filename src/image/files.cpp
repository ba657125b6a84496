#include "sunlit/image/files.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "sunlit/image/unfinished_file.h"

namespace sunlit::image {
namespace {

[[noreturn]] void fail(const std::string& path, const char* what) {
  throw std::runtime_error(path + ": " + what + ": " + reasonOf(errno));
}

/// The first of the links on the way to `path` that leads to what is not there; empty where none does.
std::filesystem::path danglingLinkOf(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::path way;
  for (const std::filesystem::path& name : path) {
    way /= name;
    if (std::filesystem::is_symlink(way, error) && !std::filesystem::exists(way, error)) return way;
  }
  return {};
}

/// Whether a file of this name is an UnfinishedFile of a process that does not run here. It may run in
/// another container, or on another computer.
bool hasNoProcess(const std::string& name) {
  static const std::regex form(std::string(R"(.+\.([0-9]{1,9})\.[0-9]+\)") + UnfinishedFile::kEnding +
                               R"((\.[a-z0-9]+)?)");
  std::smatch match;
  if (!std::regex_match(name, match, form)) return false;
  return ::kill(static_cast<pid_t>(std::stol(match[1])), 0) != 0 && errno == ESRCH;
}

/// But those that somebody writes to.
void removeUnlocked(const std::vector<std::filesystem::path>& paths) {
  std::error_code ignored;
  for (const std::filesystem::path& path : paths) {
    const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
    if (file < 0) continue;
    if (::flock(file, LOCK_EX | LOCK_NB) == 0) std::filesystem::remove(path, ignored);
    ::close(file);
  }
}

/// https://github.com/git-lfs/git-lfs/blob/main/docs/spec.md
bool isLfsPointer(const std::string& path) {
  const std::string begin = "version https://git-lfs.github.com/spec/v1";
  std::string read(begin.size(), '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(read.data(), static_cast<std::streamsize>(read.size()));
  return read == begin;
}

template <int kChannels>
void writeMap(const std::string& path, const Picture<float, kChannels>& image) {
  std::ostringstream header;
  header << (kChannels == 3 ? "PF" : "Pf") << "\n" << image.width << " " << image.height << "\n-1.0\n";
  std::string bytes = header.str();
  const std::size_t row_bytes = static_cast<std::size_t>(image.width) * kChannels * sizeof(float);
  for (int y = image.height - 1; y >= 0; --y) {
    bytes.append(reinterpret_cast<const char*>(image.at(0, y)), row_bytes);
  }
  writeFileAtomically(path, bytes);
}

template <int kChannels>
Picture<float, kChannels> readMap(const std::string& path) {
  const std::string bytes = readWholeFile(path);
  std::istringstream in(bytes);
  std::string kind;
  int width = 0;
  int height = 0;
  double scale = 0.0;
  in >> kind >> width >> height >> scale;
  const std::string wanted = kChannels == 3 ? "PF" : "Pf";
  constexpr int kLargest = 65535;
  if (!in || kind != wanted || width < 1 || width > kLargest || height < 1 || height > kLargest ||
      scale >= 0.0) {
    throw std::runtime_error(path + ": read: not a little-endian \"" + wanted + "\" float map");
  }
  const std::size_t start = static_cast<std::size_t>(in.tellg()) + 1;  // one white space ends the header
  const std::size_t row_bytes = static_cast<std::size_t>(width) * kChannels * sizeof(float);
  if (bytes.size() != start + row_bytes * static_cast<std::size_t>(height)) {
    throw std::runtime_error(path + ": read: " + std::to_string(bytes.size()) + " bytes do not hold " +
                             std::to_string(width) + "×" + std::to_string(height) + " pixels");
  }
  Picture<float, kChannels> image(width, height);
  for (int y = 0; y < height; ++y) {
    std::memcpy(image.at(0, y), bytes.data() + start + row_bytes * static_cast<std::size_t>(height - 1 - y),
                row_bytes);
  }
  return image;
}

}  // namespace

std::string reasonOf(int error) {
  const std::string said = std::strerror(error);
  const bool is_room = error == ENOSPC || error == EDQUOT;
  if (is_room) return said + "; make room there and start the same again";
  if (error == EFBIG) return said + "; raise the limit (ulimit -f) and start the same again";
  return said;
}

void prepareProcess() {
  // What is opened gets the least number that is free.
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream)
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", O_RDWR);
  ::signal(SIGXFSZ, SIG_IGN);
}

void requireContent(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status))
    throw std::runtime_error(path + ": this is a pipe or a device, and no file");
  if (fs::is_regular_file(status) && isLfsPointer(path))
    throw ContentMissing(
        path + ": this is a Git LFS pointer, and not the file itself: run `git lfs pull` in its folder");
}

std::string readWholeFile(const std::string& path) {
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    fail(path, "open");
  }
  std::string bytes;
  std::array<char, 65536> part;  // by read(), which tells of a fault without an exception that names no file
  while (in.read(part.data(), part.size()) || in.gcount() > 0)
    bytes.append(part.data(), static_cast<std::size_t>(in.gcount()));
  if (in.bad()) {
    fail(path, "read");
  }
  return bytes;
}

void moveIntoPlace(const std::string& finished, const std::string& path) {
  const int file = ::open(finished.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    fail(path, "open");
  }
  const int error = ::fsync(file) == 0 ? 0 : errno;
  ::close(file);
  if (error != 0) {
    errno = error;
    fail(path, "fsync");
  }
  if (::rename(finished.c_str(), path.c_str()) != 0) {
    fail(path, "rename");
  }
  // The new name must last as well. Some file systems cannot sync a folder; the file itself is safe by then.
  const std::size_t slash = path.find_last_of('/');
  const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0) {
    static_cast<void>(::fsync(descriptor));
    ::close(descriptor);
  }
}

void makeFolder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error && std::filesystem::is_directory(folder)) return;
  std::string reason = reasonOf(error ? error.value() : ENOTDIR);
  if (const std::filesystem::path link = danglingLinkOf(folder); !link.empty())
    reason = link.string() + " is a link to " + std::filesystem::read_symlink(link).string() +
             ", which is not there";
  throw std::runtime_error(folder + ": the folder cannot be made: " + reason);
}

void writeFileAtomically(const std::string& path, const std::string& bytes) {
  UnfinishedFile file(path);
  file.write(bytes.data(), bytes.size());
  file.keep();
}

void removeUnfinished(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code ignored;  // who cannot read the folder will say so when he writes to it
  std::vector<fs::path> abandoned;
  fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, ignored), end;
  for (; !ignored && entry != end; entry.increment(ignored)) {
    if (hasNoProcess(entry->path().filename().string())) abandoned.push_back(entry->path());
  }
  removeUnlocked(abandoned);
}

void removeUnfinishedOf(const std::string& path) {
  namespace fs = std::filesystem;
  const std::string name = fs::path(path).filename().string() + '.';
  std::error_code ignored;  // as above
  std::vector<fs::path> abandoned;
  fs::directory_iterator entry(fs::absolute(path).parent_path(), ignored), end;
  for (; !ignored && entry != end; entry.increment(ignored)) {
    const std::string found = entry->path().filename().string();
    if (found.compare(0, name.size(), name) == 0 && hasNoProcess(found)) abandoned.push_back(entry->path());
  }
  removeUnlocked(abandoned);
}

void writePfm(const std::string& path, const LinearImage& image) {
  writeMap(path, image);
}
void writePfm(const std::string& path, const DepthImage& image) {
  writeMap(path, image);
}
LinearImage readLinearPfm(const std::string& path) {
  return readMap<3>(path);
}
DepthImage readDepthPfm(const std::string& path) {
  return readMap<1>(path);
}

}  // namespace sunlit::image
