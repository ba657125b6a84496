#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <locale>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "evaluate/files/files.h"
#include "sunlit/evaluate/trajectory/trajectory.h"
#include "sunlit/image/files.h"
#include "sunlit/quantity/columns.h"
#include "sunlit/quantity/range.h"
#include "sunlit/quantity/utf8.h"

namespace sunlit::evaluate {
namespace {

using Fields = std::vector<std::string>;

/// Which column is what, and what a stamp counts.
struct Form {
  Fields columns;          ///< names of the first eight
  std::size_t x, y, z, w;  ///< of the quaternion
  int digits;              ///< of a nanosecond after a stamp's point
  const char* stamp;       ///< in words
};

const Form kTum = {
    {"timestamp", "tx", "ty", "tz", "qx", "qy", "qz", "qw"}, 4, 5, 6, 7, 9, "a number of seconds"};
/// As ORB-SLAM3 writes it by SaveTrajectoryEuRoC().
const Form kTumOfNanoseconds = {kTum.columns, kTum.x, kTum.y, kTum.z, kTum.w, 0, "a number of nanoseconds"};
const Form kEuroc = {
    {"timestamp", "x", "y", "z", "qw", "qx", "qy", "qz"}, 5, 6, 7, 4, 0, "a number of nanoseconds"};
constexpr std::size_t kLeastColumns = 8;
constexpr std::size_t kEurocColumns = 17;
/// m; what is further off is a slip, and would leave a double no micrometre.
const Range kCoordinate{-1e9, 1e9};

bool isDecimalDigit(char c) {
  return c >= '0' && c <= '9';
}

/// The exponent "e+09" that `text` ends in from `at`, 0 where it ends there; empty for anything else.
std::optional<int> exponentOf(const std::string& text, std::size_t at) {
  if (at == text.size()) return 0;
  if (text[at] != 'e' && text[at] != 'E') return std::nullopt;
  const char* begin = text.data() + at + 1;
  const char* const end = text.data() + text.size();
  if (begin != end && *begin == '+' && begin + 1 != end && isDecimalDigit(begin[1])) ++begin;
  int exponent = 0;
  const auto [stopped, error] = std::from_chars(begin, end, exponent);
  constexpr int kLargest = 400;  // so that no text becomes a long row of zeros
  if (error != std::errc() || stopped != end || std::abs(exponent) > kLargest) return std::nullopt;
  return exponent;
}

/// A decimal number times 10^power, rounded to a whole one, halves away from 0. By its digits: a double has
/// none left for nanoseconds in seconds since 1970. Empty for what is no decimal number, or too large.
std::optional<std::int64_t> scaledWhole(const std::string& text, int power) {
  std::size_t at = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  const bool is_negative = at == 1 && text[0] == '-';
  std::string digits = "0";
  bool has_point = false;
  for (; at < text.size() && (isDecimalDigit(text[at]) || (text[at] == '.' && !has_point)); ++at) {
    if (text[at] == '.') {
      has_point = true;
    } else {
      digits += text[at];
      if (has_point) --power;
    }
  }
  const std::optional<int> exponent = exponentOf(text, at);
  if (digits.size() == 1 || !exponent) return std::nullopt;
  power += *exponent;
  bool is_rounded_up = false;
  const auto cut = static_cast<std::size_t>(std::max(-power, 0));
  if (power > 0) {
    digits.append(static_cast<std::size_t>(power), '0');
  } else if (cut < digits.size()) {
    is_rounded_up = cut > 0 && digits[digits.size() - cut] >= '5';
    digits.resize(digits.size() - cut);
  } else {
    digits = "0";
  }
  std::int64_t whole = 0;
  const auto [stopped, error] = std::from_chars(digits.data(), digits.data() + digits.size(), whole);
  if (error != std::errc() || whole == std::numeric_limits<std::int64_t>::max()) return std::nullopt;
  if (is_rounded_up) ++whole;
  return is_negative ? -whole : whole;
}

/// A file being read.
class Reader {
 public:
  Reader(const std::string& file, std::vector<std::int64_t>* repeated) : file_(file), repeated_(repeated) {}

  Trajectory read() {
    std::ifstream stream(file_);
    if (!stream) throw std::runtime_error(file_ + ": cannot be opened: " + std::strerror(errno));
    for (std::string line; std::getline(stream, line);) {
      if (++line_number_ == 1) line = utf8Of(std::move(line), file_);
      const std::size_t comment = std::min(line.find('#'), line.size());
      if (columns_ == 0 && line.find("q_RS_w", comment) != std::string::npos) form_ = &kEuroc;
      line = trimmed(line.substr(0, comment));
      if (!line.empty()) readLine(line);
    }
    if (stream.bad()) throw std::runtime_error(file_ + ": cannot be read: " + std::strerror(errno));
    if (poses_.empty())
      throw std::runtime_error(file_ + ": holds no pose, but must have lines of " + columns());
    requireNanoseconds();
    return std::move(poses_);
  }

 private:
  /// Milliseconds and microseconds since 1970 are whole numbers of as many digits as nanoseconds since a
  /// start.
  void requireNanoseconds() const {
    if (form_ != &kTumOfNanoseconds || poses_.size() < 2) return;
    constexpr double kMost_hz = 5000.0;
    const auto steps = static_cast<double>(poses_.size() - 1);
    const double hz = 1e9 * steps / static_cast<double>(poses_.back().stamp_ns - poses_.front().stamp_ns);
    if (hz <= kMost_hz) return;
    throw std::runtime_error(
        file_ + ": timestamps beyond 9.2e9 are taken as nanoseconds, of which these would tell " +
        std::to_string(std::llround(hz)) +
        " poses a second, but it must be 5000 at most: write milliseconds and microseconds as seconds");
  }

  [[noreturn]] void fail(const std::string& wrong) const {
    throw std::runtime_error(file_ + ":" + std::to_string(line_number_) + ": " + wrong);
  }

  std::string columns() const {
    std::string names;
    for (const std::string& name : form_->columns) names += (names.empty() ? "" : " ") + name;
    return names + (form_ == &kEuroc ? " …" : "") + (form_->digits == 0 ? " (ns, m)" : " (s, m)");
  }

  /// By the first line; all others are of the same.
  void chooseForm(const Fields& fields, bool has_commas) {
    if (has_commas && fields.size() == kEurocColumns) form_ = &kEuroc;
    const auto fits = [&](const Form& form) {
      return !fields.empty() && scaledWhole(fields[0], form.digits).has_value();
    };
    if (form_ == &kTum && !fits(kTum) && fits(kTumOfNanoseconds)) form_ = &kTumOfNanoseconds;
    columns_ = form_ == &kEuroc ? std::max(fields.size(), kLeastColumns) : kLeastColumns;
  }

  std::int64_t stamp(const std::string& text) const {
    const std::optional<std::int64_t> stamp_ns = scaledWhole(text, form_->digits);
    if (!stamp_ns) fail(refusal("timestamp", '"' + text + '"', form_->stamp) + " within ±9.2e9 s");
    if (!poses_.empty() && *stamp_ns <= poses_.back().stamp_ns && !isLeftOut(*stamp_ns))
      fail(refusal("timestamp", text, "above that of the pose before: stamps increase"));
    return *stamp_ns;
  }

  bool isLeftOut(std::int64_t stamp_ns) const {
    return repeated_ != nullptr && !poses_.empty() && stamp_ns == poses_.back().stamp_ns;
  }

  double number(const Fields& fields, std::size_t column, const Range& range = {}) const {
    std::istringstream stream(fields[column]);
    stream.imbue(std::locale::classic());  // a decimal point, whatever the user's language
    double value = 0.0;
    // Streams take neither "nan" nor "inf", so those end up here as well.
    if (!(stream >> value) || stream.peek() != std::char_traits<char>::eof() || !range.contains(value))
      fail(refusal(form_->columns[column], '"' + fields[column] + '"', range.words()));
    return value;
  }

  void readLine(const std::string& line) {
    const bool has_commas = line.find(',') != std::string::npos;
    const Fields fields = has_commas ? splitAtCommas(line) : splitAtBlanks(line);
    if (columns_ == 0) chooseForm(fields, has_commas);
    if (fields.size() != columns_) {
      fail("has " + std::to_string(fields.size()) + (fields.size() == 1 ? " column" : " columns") +
           ", but must have " + std::to_string(columns_) + ": " + columns());
    }
    StampedPose pose;
    pose.stamp_ns = stamp(fields[0]);
    pose.position = {number(fields, 1, kCoordinate), number(fields, 2, kCoordinate),
                     number(fields, 3, kCoordinate)};
    const Eigen::Quaterniond read(number(fields, form_->w), number(fields, form_->x),
                                  number(fields, form_->y), number(fields, form_->z));
    if (!(std::abs(read.norm() - 1.0) <= kQuaternionTolerance)) {
      fail(refusal("the length of the quaternion", textOf(read.norm()),
                   "1 within " + textOf(kQuaternionTolerance)));
    }
    pose.orientation = read.normalized();
    if (isLeftOut(pose.stamp_ns)) {
      repeated_->push_back(pose.stamp_ns);
    } else {
      poses_.push_back(pose);
    }
  }

  std::string file_;
  std::vector<std::int64_t>* repeated_;  ///< null: none may be
  Trajectory poses_;
  std::size_t line_number_ = 0;
  std::size_t columns_ = 0;  ///< 0 until the first line
  const Form* form_ = &kTum;
};

}  // namespace

Trajectory readTrajectory(const std::string& file, std::vector<std::int64_t>* repeated) {
  return Reader(file, repeated).read();
}

void writeTrajectory(const std::string& file, const Trajectory& trajectory) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (const StampedPose& pose : trajectory) {
    const Eigen::Vector3d& p = pose.position;
    const Eigen::Quaterniond& q = pose.orientation;
    text += formatStamp(pose.stamp_ns);
    for (const double number : {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()})
      text += " " + formatNumber(number);
    text += "\n";
  }
  image::writeFileAtomically(file, text);
}

StampedPose interpolated(const StampedPose& before, const StampedPose& after, std::int64_t stamp_ns) {
  const double share =
      static_cast<double>(stamp_ns - before.stamp_ns) / static_cast<double>(after.stamp_ns - before.stamp_ns);
  return {stamp_ns, before.position + share * (after.position - before.position),
          before.orientation.slerp(share, after.orientation)};
}

double lengthOf(const Trajectory& trajectory) {
  double length = 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    length += (trajectory[i].position - trajectory[i - 1].position).norm();
  return length;
}

}  // namespace sunlit::evaluate
