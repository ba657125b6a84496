/// A number that tells contents apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace sunlit::light {

/// 128 bits over all bytes added, in order. Not against forgery; the same on all machines of one byte order.
class ContentHash {
 public:
  void addBytes(const void* data, std::size_t size);
  template <typename Value>
  void add(const Value& value) {
    static_assert(std::is_arithmetic_v<Value> || std::is_enum_v<Value>);
    addBytes(&value, sizeof(value));
  }
  /// Elements without padding.
  template <typename Value>
  void add(const std::vector<Value>& values) {
    add(static_cast<std::uint64_t>(values.size()));
    addBytes(values.data(), values.size() * sizeof(Value));
  }

  std::uint64_t first() const { return a_; }
  std::uint64_t second() const { return b_; }
  std::string text() const;  ///< 32 hexadecimal digits

 private:
  void addWord(std::uint64_t word);
  std::uint64_t a_ = 0x243f6a8885a308d3ull, b_ = 0x13198a2e03707344ull;
};

}  // namespace sunlit::light
