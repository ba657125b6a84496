/// What a run tells the person at the terminal, now and then.
#pragma once

#include <chrono>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "ros/render/wait.h"
#include "sunlit/studio/reports.h"
#include "sunlit/studio/stopwatch.h"

namespace sunlit::ros_interface {

/// "pose 120 of 991 (12 %), 85 ms a pose, 1 min 14 s left", at most every few seconds.
class PoseLog {
 public:
  /// `position` of `positions` are rendered.
  void report(int position, int positions);
  /// Until the last pose, as of the latest report; NaN where nobody can tell yet.
  double secondsLeft() const { return seconds_left_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_;
  Clock::time_point latest_;
  int begin_position_ = -1;
  double seconds_left_ = std::numeric_limits<double>::quiet_NaN();
};

/// "Waiting for …", every few seconds, once a wait is long enough to wonder about; a warning once it is
/// longer than other nodes take to load.
class WaitLog {
 public:
  explicit WaitLog(studio::Stopwatch::Clock clock = studio::Stopwatch::steadyTime)
      : clock_(std::move(clock)) {}
  /// What is waited for now; empty: nothing. Whether it has been for so long that it is worth a word.
  bool report(const Wait& waits_for);

 private:
  studio::Stopwatch::Clock clock_;
  double begin_s_ = 0.0;
  std::optional<double> latest_s_;
  std::string key_;
};

/// What the studio tells, in the log; how far a bake is every few seconds.
studio::Reports loggedReports();

}  // namespace sunlit::ros_interface
