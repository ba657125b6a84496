/// Threads that take tasks in order, until one throws.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace sunlit::evaluate {

class WorkQueue {
 public:
  /// `threads` > 0; fewer, where so many cannot be started. Throws std::runtime_error where none can.
  explicit WorkQueue(int threads);
  ~WorkQueue();  ///< drops tasks that have not begun
  void add(std::function<void()> task);
  /// Waiting and running tasks.
  std::size_t size() const;
  /// Blocks until at most `tasks` wait or run, or a task has thrown.
  void waitForAtMost(std::size_t tasks) const;
  /// The same, but no longer than so: false if it was not long enough.
  bool waitForAtMost(std::size_t tasks, std::chrono::milliseconds longest) const;
  /// Throws what a task threw.
  void rethrow() const;

 private:
  bool hasAtMost(std::size_t tasks) const { return fault_ || tasks_.size() + running_ <= tasks; }
  void run();

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  std::size_t running_ = 0;
  bool is_closed_ = false;
  std::exception_ptr fault_;
  std::vector<std::thread> threads_;
};

}  // namespace sunlit::evaluate
