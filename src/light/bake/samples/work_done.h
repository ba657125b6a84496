/// How far a work is.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>
#include <utility>

namespace sunlit::light {

/// Gets the share of a work that is done, 0 … 1, about: never less than before, from any thread, but never
/// from two at once. May be empty.
using Progress = std::function<void(double)>;

/// Of a part of a work, from `from` to `to` of it.
inline Progress partOf(const Progress& progress, double from, double to) {
  if (!progress) return nullptr;
  return [progress, from, to](double share) { progress(from + (to - from) * share); };
}

/// Tells how much is done of a work for many threads.
class WorkDone {
 public:
  WorkDone(Progress progress, std::size_t parts) : progress_(std::move(progress)), parts_(parts) {}

  void add(std::size_t parts = 1) {
    if (!progress_) return;
    constexpr std::size_t kSteps = 500;  // more of them nobody needs to know
    const std::size_t before = done_.fetch_add(parts), now = before + parts;
    if (before * kSteps / parts_ == now * kSteps / parts_) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    if (now <= told_) return;  // another thread came first
    told_ = now;
    progress_(static_cast<double>(now) / static_cast<double>(parts_));
  }

 private:
  const Progress progress_;
  const std::size_t parts_;
  std::atomic<std::size_t> done_ = 0;
  std::mutex mutex_;
  std::size_t told_ = 0;
};

}  // namespace sunlit::light
