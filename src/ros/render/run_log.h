/// What a run tells the person at the terminal, now and then.
#pragma once

#include <chrono>
#include <string>

namespace sunlit::ros_interface {

/// "pose 120 of 991 (12 %), 85 ms a pose, 1 min 14 s left", at most every few seconds.
class ProgressLog {
 public:
  /// `position` of `positions` are rendered.
  void report(int position, int positions);

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_;
  Clock::time_point latest_;
  int begin_position_ = -1;
};

/// "Waiting for …", every few seconds, once a wait is long enough to wonder about.
class WaitLog {
 public:
  /// What is waited for now; empty: nothing.
  void report(const std::string& waits_for);

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_;
  Clock::time_point latest_;
  std::string waits_for_;
};

/// "1 min 14 s"
std::string printedDuration(double seconds);

}  // namespace sunlit::ros_interface
