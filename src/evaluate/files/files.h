/// Small text files that survive a crash.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sunlit::evaluate {

/// A text file that only grows. Each text is handed over in one write(), so a crash can tear only the last
/// one.
class AppendFile {
 public:
  AppendFile() = default;
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;
  ~AppendFile();
  /// Starts with `header` (a line) where the file is new or empty. Throws std::runtime_error with path and
  /// reason.
  void open(const std::string& path, const std::string& header);
  /// All of `text`, or nothing and std::runtime_error with path and reason, as every append() from then on.
  void append(const std::string& text);
  void close();

 private:
  std::string path_;
  int descriptor_ = -1;
  bool is_broken_ = false;
};

/// Calls `use` with the fields of each row of a CSV file after its header, cut at the commas; of one that
/// does not exist never. Never holds more than a row. Returns how many lines were left out: 1 where the file
/// ends within one. Throws std::runtime_error, with path and line, for another header or number of fields,
/// and for what `use` throws.
std::size_t forEachCsvRow(const std::string& path, const std::string& header,
                          const std::function<void(const std::vector<std::string>& fields)>& use);

/// 17 digits, so that reading gives the same number back; "nan" for NaN.
std::string formatNumber(double value);
/// Reads formatNumber() and any other decimal number. Throws std::runtime_error.
double parseNumber(const std::string& text);
/// "secs.nsecs" with nine digits after the point.
std::string formatStamp(std::int64_t nanoseconds);
std::int64_t parseStamp(const std::string& text);
/// A whole number that a double knows exactly. Throws std::runtime_error.
std::int64_t parsePose(const std::string& text);
/// A field of a CSV file: in quotes where it has commas, quotes or line ends.
std::string csvField(const std::string& text);

}  // namespace sunlit::evaluate
