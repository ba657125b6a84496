/// What came of late and may still be asked for, in bounded memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

namespace sunlit::evaluate {

/// Poses that wait for the image of their stamp: 22 min of them at 50 Hz, longer than images lag behind. Each
/// takes less than 1 kB in all.
constexpr std::size_t kMostWaitingPoses = 65536;

/// Values by stamp, or by another key. Where there are too many, that which came first is forgotten.
template <typename Value>
class Recent {
 public:
  explicit Recent(std::size_t most = kMostWaitingPoses) : most_(most) {}

  /// Null: it never came, was taken or is forgotten.
  Value* find(std::int64_t key) {
    const auto found = held_.find(key);
    return found == held_.end() ? nullptr : &found->second.value;
  }
  /// Of a key that is not held. True where another was forgotten.
  bool add(std::int64_t key, Value value) {
    held_.emplace(key, Held{std::move(value), ++count_});
    by_age_.emplace(count_, key);
    if (held_.size() <= most_) return false;
    take(by_age_.begin()->second);
    return true;
  }
  std::optional<Value> take(std::int64_t key) {
    const auto found = held_.find(key);
    if (found == held_.end()) return std::nullopt;
    std::optional<Value> value = std::move(found->second.value);
    by_age_.erase(found->second.age);
    held_.erase(found);
    return value;
  }
  std::size_t size() const { return held_.size(); }
  /// There is one.
  std::int64_t leastKey() const { return held_.begin()->first; }

 private:
  struct Held {
    Value value;
    std::uint64_t age = 0;
  };
  std::size_t most_;
  std::uint64_t count_ = 0;
  std::map<std::int64_t, Held> held_;
  std::map<std::uint64_t, std::int64_t> by_age_;  // keys in the order in which they came
};

}  // namespace sunlit::evaluate
