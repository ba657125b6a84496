#include "tiff_no_data.h"

#include <cmath>
#include <cstring>
#include <sstream>
#include <string>

namespace sunlit::image {
namespace {

/// The bytes of a TIFF file (TIFF 6.0, section 2).
class TiffBytes {
 public:
  TiffBytes(const std::uint8_t* bytes, std::size_t size) : bytes_(bytes), size_(size) {
    constexpr char kLittle[] = "II*", kBig[] = "MM\0*";
    constexpr std::size_t kStart = 4;
    is_little_ = has(0, kStart) && std::memcmp(bytes, kLittle, kStart) == 0;
    is_tiff_ = is_little_ || (has(0, kStart) && std::memcmp(bytes, kBig, kStart) == 0);
  }

  bool isTiff() const { return is_tiff_; }
  bool has(std::size_t at, std::size_t count) const { return at <= size_ && count <= size_ - at; }
  /// The number of `count` bytes at `at`, where has() them.
  std::size_t number(std::size_t at, std::size_t count) const {
    std::size_t number = 0;
    for (std::size_t i = 0; i < count; ++i)
      number = number << 8 | bytes_[at + (is_little_ ? count - 1 - i : i)];
    return number;
  }
  std::string text(std::size_t at, std::size_t count) const {
    return {reinterpret_cast<const char*>(bytes_) + at, count};
  }

 private:
  const std::uint8_t* bytes_;
  std::size_t size_;
  bool is_little_ = false, is_tiff_ = false;
};

}  // namespace

std::optional<double> tiffNoData(const std::uint8_t* bytes, std::size_t size) {
  constexpr std::size_t kFirst = 4, kEntry = 12, kCount = 4, kValue = 8, kInPlace = 4;  // bytes
  constexpr std::size_t kNoData = 42113;
  const TiffBytes file(bytes, size);
  if (!file.isTiff() || !file.has(kFirst, 4)) return std::nullopt;
  const std::size_t directory = file.number(kFirst, 4);
  if (!file.has(directory, 2)) return std::nullopt;
  const std::size_t entries = file.number(directory, 2);
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + kEntry * i;
    if (!file.has(entry, kEntry)) return std::nullopt;
    if (file.number(entry, 2) != kNoData) continue;
    const std::size_t length = file.number(entry + kCount, 4);
    const std::size_t at = length <= kInPlace ? entry + kValue : file.number(entry + kValue, 4);
    if (!file.has(at, length)) return std::nullopt;
    double number = 0.0;
    std::istringstream text(file.text(at, length));
    return text >> number && std::isfinite(number) ? std::optional<double>(number) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace sunlit::image
