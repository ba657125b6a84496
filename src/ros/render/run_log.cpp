#include "ros/render/run_log.h"

#include <ros/console.h>

#include <cmath>

namespace sunlit::ros_interface {

namespace {

constexpr std::chrono::seconds kInterval(5);
constexpr std::chrono::seconds kPatience(2);

}  // namespace

std::string printedDuration(double seconds) {
  const auto whole = static_cast<long>(std::lround(seconds));
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

void ProgressLog::report(int position, int positions) {
  const Clock::time_point now = Clock::now();
  if (begin_position_ < 0) {
    begin_position_ = position;
    begin_ = latest_ = now;
  }
  const bool last = position >= positions;
  if (position == begin_position_ || (now - latest_ < kInterval && !last)) return;
  latest_ = now;
  const double per_pose_s =
      std::chrono::duration<double>(now - begin_).count() / (position - begin_position_);
  ROS_INFO("pose %d of %d (%d %%), %.0f ms a pose, %s left", position, positions, 100 * position / positions,
           1e3 * per_pose_s, printedDuration(per_pose_s * (positions - position)).c_str());
}

void WaitLog::report(const std::string& waits_for) {
  const Clock::time_point now = Clock::now();
  if (waits_for != waits_for_)
    begin_ = now;  // a reader that makes progress, however slowly, is no reason to wonder
  waits_for_ = waits_for;
  if (waits_for.empty() || now - begin_ < kPatience || now - latest_ < kInterval) return;
  latest_ = now;
  ROS_WARN("Waiting for %s", waits_for.c_str());
}

}  // namespace sunlit::ros_interface
