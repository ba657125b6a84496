/// The bytes of a texture: its own, or part of what somebody else keeps.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include "sunlit/image/file_bytes.h"

namespace sunlit::scene {

/// Several processes that map one file share its texels. Copies of such are no copies of bytes.
class Texels {
 public:
  Texels() = default;
  Texels(std::vector<std::uint8_t> bytes) : own_(std::move(bytes)) {}
  Texels(std::initializer_list<std::uint8_t> bytes) : own_(bytes) {}
  /// `size` bytes at `data`, within `owner`, not null.
  static Texels within(std::shared_ptr<const image::FileBytes> owner, const std::uint8_t* data,
                       std::size_t size) {
    Texels texels;
    texels.owner_ = std::move(owner);
    texels.data_ = data;
    texels.size_ = size;
    return texels;
  }

  const std::uint8_t* data() const { return owner_ ? data_ : own_.data(); }
  std::size_t size() const { return owner_ ? size_ : own_.size(); }
  bool empty() const { return size() == 0; }
  const std::uint8_t& operator[](std::size_t i) const { return data()[i]; }
  const std::uint8_t* begin() const { return data(); }
  const std::uint8_t* end() const { return data() + size(); }

  /// Nobody will look at all of them for a while: see image::FileBytes.
  void letGo() const {
    if (owner_) owner_->letGo(data_, size_);
  }

  /// To be changed: where others own them, a copy from now on.
  std::vector<std::uint8_t>& own() {
    if (owner_) *this = std::vector<std::uint8_t>(begin(), end());
    return own_;
  }

 private:
  std::vector<std::uint8_t> own_;
  std::shared_ptr<const image::FileBytes> owner_;  ///< null: they are own_
  const std::uint8_t* data_ = nullptr;
  std::size_t size_ = 0;
};

inline bool operator==(const Texels& a, const Texels& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace sunlit::scene
