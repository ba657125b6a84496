/// Many values of one kind: in memory while they are made, or where a file that holds them is mapped.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include "sunlit/image/file_bytes.h"

namespace sunlit::image {

/// Arrays in files begin at multiples of it, for those who read them where they lie.
constexpr std::size_t kKeptAlignment = 64;
/// Where the next array begins, from `offset` on.
constexpr std::size_t aligned(std::size_t offset) {
  return (offset + kKeptAlignment - 1) / kKeptAlignment * kKeptAlignment;
}

/// A std::vector to those who fill it. What lies in a file is only read, and several processes share it; the
/// first to write to it gets a copy.
template <typename T>
class KeptArray {
 public:
  KeptArray() = default;
  KeptArray(std::vector<T> values) : own_(std::move(values)) {}  // NOLINT: a vector is one
  KeptArray(std::initializer_list<T> values) : own_(values) {}
  /// `count` of them from `first` on, aligned as they need be, within `holder`, not null.
  KeptArray(const T* first, std::size_t count, std::shared_ptr<const FileBytes> holder)
      : holder_(std::move(holder)), first_(first), count_(count) {}

  std::size_t size() const { return holder_ ? count_ : own_.size(); }
  bool empty() const { return size() == 0; }
  const T* data() const { return holder_ ? first_ : own_.data(); }
  const T& operator[](std::size_t i) const { return data()[i]; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size(); }

  friend bool operator==(const KeptArray& a, const KeptArray& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

  /// Nobody will look at those from `begin` to `end` for a while: see image::FileBytes.
  void letGo(std::size_t begin, std::size_t end) const {
    if (holder_) holder_->letGo(first_ + begin, (end - begin) * sizeof(T));
  }
  void letGo() const { letGo(0, size()); }

  T* data() { return own().data(); }
  T& operator[](std::size_t i) { return own()[i]; }
  T* begin() { return data(); }
  T* end() { return data() + own_.size(); }
  T& back() { return own().back(); }
  void push_back(const T& value) { own().push_back(value); }
  void resize(std::size_t count) { own().resize(count); }
  void assign(std::size_t count, const T& value) { own().assign(count, value); }
  /// To change them in any other way.
  std::vector<T>& own() {
    if (holder_) {
      own_.assign(first_, first_ + count_);
      holder_.reset();
    }
    return own_;
  }

 private:
  std::vector<T> own_;
  std::shared_ptr<const FileBytes> holder_;  ///< null: they are in own_
  const T* first_ = nullptr;
  std::size_t count_ = 0;
};

/// Where values lie that somebody else keeps, and no longer changes.
template <typename T>
class ArrayView {
 public:
  ArrayView() = default;
  ArrayView(const KeptArray<T>& values) : first_(values.data()), count_(values.size()) {}  // NOLINT

  std::size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  const T* data() const { return first_; }
  const T& operator[](std::size_t i) const { return first_[i]; }
  const T* begin() const { return first_; }
  const T* end() const { return first_ + count_; }

 private:
  const T* first_ = nullptr;
  std::size_t count_ = 0;
};

}  // namespace sunlit::image
