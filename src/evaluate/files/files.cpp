#include "evaluate/files/files.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "sunlit/image/files.h"

namespace sunlit::evaluate {
namespace {

[[noreturn]] void failWith(const std::string& path, const std::string& what) {
  throw std::runtime_error(path + ": " + what + ": " + image::reasonOf(errno));
}

// How much of the text was written: all of it, or errno says why not.
std::size_t writtenOf(int descriptor, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t written = ::write(descriptor, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) break;
    done += static_cast<std::size_t>(written);
  }
  return done;
}

// As csvField() writes them: within quotes a comma is no end, and a quote stands twice.
std::vector<std::string> cut(const std::string& line) {
  std::vector<std::string> fields;
  if (line.empty()) return fields;
  fields.emplace_back();
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[++i];
    } else if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ',' && !is_quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

constexpr std::int64_t kNanosecondsPerSecond = 1000000000;

}  // namespace

AppendFile::~AppendFile() {
  close();
}

void AppendFile::open(const std::string& path, const std::string& header) {
  close();
  path_ = path;
  is_broken_ = false;
  descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (descriptor_ < 0) failWith(path, "cannot be opened");
  if (::lseek(descriptor_, 0, SEEK_END) == 0) append(header + "\n");
}

void AppendFile::append(const std::string& text) {
  if (is_broken_) throw std::runtime_error(path_ + ": not written to any more, since a write had failed");
  const off_t size = ::lseek(descriptor_, 0, SEEK_END);
  if (writtenOf(descriptor_, text) == text.size()) return;
  const int reason = errno;
  is_broken_ = true;
  const bool is_mended = ::ftruncate(descriptor_, size) == 0;
  errno = reason;
  failWith(path_, is_mended ? "cannot write" : "cannot write, and ends within a line now");
}

void AppendFile::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

std::size_t forEachCsvRow(const std::string& path, const std::string& header,
                          const std::function<void(const std::vector<std::string>& fields)>& use) {
  if (!std::filesystem::exists(path)) return 0;
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) failWith(path, "cannot be opened");
  const std::size_t expected = cut(header).size();
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    if (file.eof()) return 1;
    if (number == 1) {
      if (line == header) continue;
      throw std::runtime_error(
          path + ":1: was written by another version, or is no file of ours: expected the header " + header);
    }
    try {
      const std::vector<std::string> fields = cut(line);
      if (fields.size() != expected)
        throw std::runtime_error("has " + std::to_string(fields.size()) + " fields instead of " +
                                 std::to_string(expected));
      use(fields);
    } catch (const std::exception& error) {
      throw std::runtime_error(path + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  if (file.bad()) failWith(path, "cannot be read");
  return 0;
}

std::string formatNumber(double value) {
  if (std::isnan(value)) return "nan";
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.17g", value);
  return buffer;
}

double parseNumber(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (!text.empty() && end == text.c_str() + text.size()) return value;
  throw std::runtime_error("\"" + text + "\" is not a number");
}

std::string formatStamp(std::int64_t nanoseconds) {
  const bool is_negative = nanoseconds < 0;
  const std::int64_t size = is_negative ? -nanoseconds : nanoseconds;
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%s%lld.%09lld", is_negative ? "-" : "",
                static_cast<long long>(size / kNanosecondsPerSecond),
                static_cast<long long>(size % kNanosecondsPerSecond));
  return buffer;
}

std::int64_t parseStamp(const std::string& text) {
  const std::size_t point = text.find('.');
  const bool is_digits =
      text.find_first_not_of("0123456789.", text.compare(0, 1, "-") == 0 ? 1 : 0) == std::string::npos;
  if (point == std::string::npos || text.size() != point + 10 || !is_digits) {
    throw std::runtime_error("\"" + text + "\" is not a stamp with nine digits after the point");
  }
  std::string digits = text;
  digits.erase(point, 1);
  // By a bound of its own: what is beyond is as far from any clock as a slip can be, and its negative, and
  // how far it is from another stamp, are numbers, too.
  constexpr std::int64_t kFarthest = std::int64_t{1} << 61;
  std::int64_t nanoseconds = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stopped, error] = std::from_chars(digits.data(), end, nanoseconds);
  if (error != std::errc() || stopped != end || nanoseconds < -kFarthest || nanoseconds > kFarthest)
    throw std::runtime_error("\"" + text + "\" is not a stamp within 2.3e9 s");
  return nanoseconds;
}

std::int64_t parsePose(const std::string& text) {
  const double value = parseNumber(text);
  constexpr double kExact = 9007199254740992.0;  // 2⁵³: doubles beyond are not all the whole numbers
  if (!(std::abs(value) <= kExact) || value != std::floor(value)) {
    throw std::runtime_error("\"" + text + "\" is not a pose number");
  }
  return static_cast<std::int64_t>(value);
}

std::string csvField(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c == '\n' || c == '\r' ? ' ' : c;
  }
  return quoted + "\"";
}

}  // namespace sunlit::evaluate
