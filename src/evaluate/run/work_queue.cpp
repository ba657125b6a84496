#include "evaluate/run/work_queue.h"

#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace sunlit::evaluate {

WorkQueue::WorkQueue(int threads) {
  threads_.reserve(static_cast<std::size_t>(threads));
  try {
    for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { run(); });
  } catch (const std::system_error& error) {
    // Fewer than wished do as well.
    if (threads_.empty())
      throw std::runtime_error(std::string("no thread can be started (") + error.what() +
                               "): raise ulimit -u, or the job's limit of processes");
  }
}

WorkQueue::~WorkQueue() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_closed_ = true;
    tasks_.clear();
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void WorkQueue::add(std::function<void()> task) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  changed_.notify_all();
}

std::size_t WorkQueue::size() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return tasks_.size() + running_;
}

void WorkQueue::waitForAtMost(std::size_t tasks) const {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [&] { return hasAtMost(tasks); });
}

bool WorkQueue::waitForAtMost(std::size_t tasks, std::chrono::milliseconds longest) const {
  std::unique_lock<std::mutex> lock(mutex_);
  return changed_.wait_for(lock, longest, [&] { return hasAtMost(tasks); });
}

void WorkQueue::rethrow() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (fault_) std::rethrow_exception(fault_);
}

void WorkQueue::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return is_closed_ || fault_ || !tasks_.empty(); });
    if (fault_ || tasks_.empty()) return;
    std::function<void()> task = std::move(tasks_.front());
    tasks_.pop_front();
    ++running_;
    lock.unlock();
    std::exception_ptr fault;
    try {
      task();
    } catch (...) {
      fault = std::current_exception();
    }
    task = nullptr;
    lock.lock();
    if (fault && !fault_) fault_ = fault;
    --running_;
    changed_.notify_all();
  }
}

}  // namespace sunlit::evaluate
