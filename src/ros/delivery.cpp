#include "sunlit/ros/delivery.h"

#include <ros/console.h>
#include <ros/init.h>
#include <ros/poll_manager.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>

#include "ros/socket_traffic.h"
#include "sunlit/ros/node_main.h"

namespace sunlit::ros_interface {

namespace {

constexpr std::chrono::seconds kPatience(30);

/// Whether nobody wants this process to end at once.
bool mayWait() {
  return ros::ok() && !isInterrupted();
}

/// Counts the rounds of roscpp's thread that writes to sockets.
class Rounds {
 public:
  Rounds() : connection_(ros::PollManager::instance()->addPollThreadListener([this] { count(); })) {}
  ~Rounds() { ros::PollManager::instance()->removePollThreadListener(connection_); }
  Rounds(const Rounds&) = delete;
  Rounds& operator=(const Rounds&) = delete;

  /// Waits until a round has begun and ended since the call; false if ROS shuts down, after which there is
  /// none, or on an interrupt.
  bool awaitWhole() {
    constexpr std::chrono::milliseconds kGlance(100);
    std::unique_lock<std::mutex> lock(mutex_);
    const std::uint64_t next = begun_ + 1;
    while (mayWait() && begun_ <= next) changed_.wait_for(lock, kGlance);
    return begun_ > next;
  }

 private:
  void count() {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++begun_;
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t begun_ = 0;
  boost::signals2::connection connection_;  // the last member: it may call at once
};

/// Whether everything is delivered.
bool waitUntilDelivered() {
  using Clock = std::chrono::steady_clock;
  Rounds rounds;
  // This round hands to the connections what was published since the round before.
  if (!rounds.awaitWhole()) return false;
  SentBytes sent = sentByThisProcess();
  Clock::time_point last_progress = Clock::now();
  while (Clock::now() - last_progress < kPatience) {
    if (!rounds.awaitWhole()) return false;
    const SentBytes now = sentByThisProcess();
    // A round writes as much as the sockets take: where nothing was written to empty ones, nothing is left.
    const bool nothing_written = now.arrived == sent.arrived + sent.under_way;
    if (now.under_way + now.unread == 0 && nothing_written) return true;
    if (now.arrived != sent.arrived || now.unread != sent.unread) last_progress = Clock::now();
    sent = now;
  }
  return false;
}

}  // namespace

void deliverTheLast() {
  if (waitUntilDelivered() || !mayWait()) return;
  const SentBytes sent = sentByThisProcess();
  ROS_WARN("A reader has taken nothing for %d s: %llu bytes and what waits behind them are not delivered",
           static_cast<int>(kPatience.count()),
           static_cast<unsigned long long>(sent.under_way + sent.unread));
}

}  // namespace sunlit::ros_interface
