/// A number by which contents are told apart.
#pragma once

#include <cinttypes>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace sunlit {

/// FNV-1a of 64 bits (Fowler, Noll, Vo) over all bytes added, in order. Not against forgery.
class Fingerprint {
 public:
  void add(unsigned char byte) { value_ = (value_ ^ byte) * 1099511628211u; }
  /// Elements without padding.
  template <typename Value>
  void add(const std::vector<Value>& values) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
    for (std::size_t i = 0; i < values.size() * sizeof(Value); ++i) add(bytes[i]);
  }
  std::uint64_t value() const { return value_; }
  /// 16 hexadecimal digits.
  std::string text() const {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016" PRIx64, value_);
    return digits;
  }

 private:
  std::uint64_t value_ = 14695981039346656037u;
};

}  // namespace sunlit
