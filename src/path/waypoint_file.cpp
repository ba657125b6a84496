#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <locale>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "path/waypoint_check.h"
#include "sunlit/path/path.h"
#include "sunlit/quantity/columns.h"
#include "sunlit/quantity/utf8.h"

namespace sunlit::path {
namespace {

constexpr std::size_t kTumColumns = 8;

using Fields = std::vector<std::string>;

bool isHeader(const Fields& fields) {
  Fields lower = fields;
  for (std::string& field : lower) {
    std::transform(field.begin(), field.end(), field.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  }
  return lower == Fields{"x", "y"} || lower == Fields{"x", "y", "z"};
}

std::optional<double> finiteNumber(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());  // a decimal point, whatever the user's language
  double value = 0.0;
  // Streams take neither "nan" nor "inf", so those end up here as well.
  if (!(stream >> value) || stream.peek() != std::char_traits<char>::eof() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

/// A waypoint file being read.
class Reader {
 public:
  explicit Reader(const std::string& file) : file_(file) {}

  Waypoints read() {
    // Which opens as a file does.
    std::error_code unknown;
    if (std::filesystem::is_directory(file_, unknown))
      throw std::runtime_error(file_ + ": this is a folder, and no waypoint file");
    std::ifstream stream(file_);
    if (!stream) throw std::runtime_error(file_ + ": cannot open this waypoint file");
    for (std::string line; std::getline(stream, line);) {
      if (++line_number_ == 1) line = utf8Of(std::move(line), file_);
      line = trimmed(line.substr(0, line.find('#')));
      if (!line.empty()) readLine(line);
    }
    if (stream.bad()) fail("cannot read on");
    Waypoints kept = withoutStandstills(waypoints_);
    left_out_ = waypoints_.size() - kept.size();
    if (kept.size() < 2) fail(tooFew(kept.size()) + (left_out_ > 0 ? "; " + leftOutText(left_out_) : ""));
    return kept;
  }

  /// Empty where there is nothing to tell.
  std::string note() const { return left_out_ > 0 ? file_ + ": " + leftOutText(left_out_) : ""; }

 private:
  [[noreturn]] void fail(const std::string& wrong) const {
    throw std::runtime_error(file_ + (line_number_ > 0 ? ":" + std::to_string(line_number_) : "") + ": " +
                             wrong);
  }

  double number(const std::string& text) const {
    const std::optional<double> value = finiteNumber(text);
    if (!value) fail("'" + text + "' is not a finite number");
    return *value;
  }

  void readLine(const std::string& line) {
    const bool is_first = columns_ == 0;
    if (is_first) is_csv_ = line.find(',') != std::string::npos;
    const Fields fields = is_csv_ ? splitAtCommas(line) : splitAtBlanks(line);
    if (is_first) {
      columns_ = fields.size();
      const bool known = is_csv_ ? columns_ == 2 || columns_ == 3 : columns_ == kTumColumns;
      if (!known) {
        fail(
            "expected x,y,z or x,y with commas, or the eight columns of a TUM trajectory with blanks, "
            "found " +
            std::to_string(columns_) + (columns_ == 1 ? " column" : " columns") +
            (is_csv_ ? " separated by commas" : ""));
      }
      if (is_csv_ && isHeader(fields)) return;
      if (is_csv_ && std::none_of(fields.begin(), fields.end(), finiteNumber))
        fail("the header is " + line + ", but must be x,y,z or x,y, of columns in that order and in m");
    }
    if (fields.size() != columns_) {
      fail("expected " + std::to_string(columns_) + " columns as above, found " +
           std::to_string(fields.size()));
    }
    std::vector<double> values;
    for (const std::string& field : fields) values.push_back(number(field));
    add(is_csv_ ? Eigen::Vector3d(values[0], values[1], columns_ == 3 ? values[2] : 0.0)
                : Eigen::Vector3d(values[1], values[2], values[3]));
  }

  void add(const Eigen::Vector3d& point) {
    const Eigen::Vector3d* previous = waypoints_.empty() ? nullptr : &waypoints_.back();
    // What was recorded stands still at its ends, what was written by hand by mistake.
    if (const auto fault = faultOf(point, is_csv_ ? previous : nullptr)) fail(*fault);
    waypoints_.push_back(point);
  }

  std::string file_;
  Waypoints waypoints_;
  std::size_t line_number_ = 0;
  std::size_t columns_ = 0;  ///< 0 until the first line
  bool is_csv_ = false;
  std::size_t left_out_ = 0;  ///< poses of a trajectory that are left out
};

}  // namespace

Waypoints readWaypoints(const std::string& file, const std::function<void(const std::string&)>& told) {
  Reader reader(file);
  Waypoints waypoints = reader.read();
  const std::string note = reader.note();
  if (told && !note.empty()) told(note);
  return waypoints;
}

}  // namespace sunlit::path
