/// Where the time of a run went.
#pragma once

#include <functional>
#include <mutex>
#include <ostream>
#include <string>
#include <vector>

namespace sunlit::studio {

/// Sums the wall time of named stages, which may run at the same time on several threads. What a stage does
/// within another one, on the same thread, counts for the inner one alone, so that the rows of a time sheet
/// add up.
class Stopwatch {
 public:
  /// Seconds since any fixed moment.
  using Clock = std::function<double()>;
  static double steadyTime();

  struct Entry {
    std::string stage;
    std::string what;
    int count = 0;
    double seconds = 0.0;
  };

  explicit Stopwatch(Clock clock = steadyTime) : clock_(std::move(clock)) {}

  /// Runs `work` on the account of `stage` (geometry, light …) of `what` (a condition, or pose), and hands on
  /// its result.
  template <typename Work>
  auto measure(const std::string& stage, const std::string& what, Work&& work) {
    const Charge charge(*this, stage, what);
    return work();
  }
  /// Puts what was measured elsewhere on the same accounts. Safe at any time, as entries() is.
  void add(const std::vector<Entry>& others);

  /// Of the stages that have ended, in the order in which they first did.
  std::vector<Entry> entries() const;

 private:
  class Charge {
   public:
    Charge(Stopwatch& watch, const std::string& stage, const std::string& what);
    ~Charge();
    Charge(const Charge&) = delete;
    Charge& operator=(const Charge&) = delete;

   private:
    Stopwatch& watch_;
    const std::string& stage_;
    const std::string& what_;
    Charge* around_;  ///< that this one is within, on this thread
    double inner_s_ = 0.0;
    double begin_s_;
  };
  void add(const Entry& other);

  Clock clock_;
  mutable std::mutex mutex_;  // of entries_
  std::vector<Entry> entries_;
};

/// CSV: stage,what,count,seconds.
void writeTimeSheet(const std::vector<Stopwatch::Entry>& entries, std::ostream& out);
/// Nothing where there is no such file. Throws std::runtime_error with path and line for anything that
/// writeTimeSheet() does not write.
std::vector<Stopwatch::Entry> readTimeSheet(const std::string& file);

}  // namespace sunlit::studio
