/// Where the time of a run went.
#pragma once

#include <chrono>
#include <mutex>
#include <ostream>
#include <string>
#include <vector>

namespace sunlit::ros_interface {

/// Sums the wall time of named stages, which may run at the same time on several threads.
class Stopwatch {
 public:
  /// Runs `work` on the account of `stage` (geometry, light …) of `what` (a condition, or pose), and hands on
  /// its result.
  template <typename Work>
  auto measure(const std::string& stage, const std::string& what, Work&& work) {
    const Charge charge{*this, stage, what, std::chrono::steady_clock::now()};
    return work();
  }

  struct Entry {
    std::string stage;
    std::string what;
    int count = 0;
    double seconds = 0.0;
  };
  /// In the order in which they were first measured. Only while no stage is being measured.
  const std::vector<Entry>& entries() const { return entries_; }
  /// CSV: stage,what,count,seconds.
  void write(std::ostream& out) const;

 private:
  struct Charge {
    Stopwatch& watch;
    const std::string& stage;
    const std::string& what;
    std::chrono::steady_clock::time_point begin;
    ~Charge();
  };
  Entry& entry(const std::string& stage, const std::string& what);
  std::mutex mutex_;  // of entries_
  std::vector<Entry> entries_;
};

}  // namespace sunlit::ros_interface
