/// How long work learns that its result is no longer wanted.
#pragma once

#include <exception>
#include <functional>
#include <utility>

namespace sunlit::evaluate {

/// Work ended before its result, as it was asked to: no fault.
class Stopped : public std::exception {
 public:
  const char* what() const noexcept override { return "stopped, since its result is no longer wanted"; }
};

/// Handed down to what may take seconds, which calls check() between its steps; std::stop_token of C++20 in
/// small. May be used from several threads at once.
class StopToken {
 public:
  StopToken() = default;  ///< of work that is always wanted
  /// `is_stopped` is called from all threads that work, and stays true once it is.
  explicit StopToken(std::function<bool()> is_stopped) : is_stopped_(std::move(is_stopped)) {}
  bool isStopped() const { return is_stopped_ && is_stopped_(); }
  /// Throws Stopped where the result is no longer wanted.
  void check() const {
    if (isStopped()) throw Stopped();
  }

 private:
  std::function<bool()> is_stopped_;
};

}  // namespace sunlit::evaluate
