/// A number that tells contents apart: of worlds, paths and files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace sunlit::image {

/// 128 bits over all bytes added, in order: XXH3 of xxHash 0.8. Not against forgery; the same on all machines
/// of one byte order.
class ContentHash {
 public:
  ContentHash();
  ContentHash(ContentHash&&) noexcept;
  ContentHash& operator=(ContentHash&&) noexcept;
  ~ContentHash();

  void addBytes(const void* data, std::size_t size);
  /// A number, or a list of elements without padding: how many there are, and they.
  template <typename Value>
  void add(const Value& value) {
    if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>) {
      addBytes(&value, sizeof(value));
    } else {
      add(static_cast<std::uint64_t>(value.size()));
      addBytes(value.data(), value.size() * sizeof(*value.data()));
    }
  }
  /// All bytes of a file. Whether it could be read.
  [[nodiscard]] bool addFile(const std::string& path);

  struct Number {
    std::uint64_t high, low;
    bool operator==(const Number& other) const { return high == other.high && low == other.low; }
    bool operator!=(const Number& other) const { return !(*this == other); }
  };
  Number number() const;
  std::string text() const;  ///< 32 hexadecimal digits

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sunlit::image
