#include "ros/render/run_log.h"

#include <ros/console.h>

#include "ros/render/input_log.h"
#include "sunlit/quantity/duration.h"

namespace sunlit::ros_interface {

namespace {

constexpr std::chrono::seconds kInterval(5);
constexpr double kPatience_s = 2.0, kUsual_s = 30.0;

/// Says every few seconds how far a bake is.
class BakeLog {
 public:
  void operator()(double share, double seconds_left) {
    const Clock::time_point now = Clock::now();
    if (now - latest_ < kInterval) return;
    latest_ = now;
    ROS_INFO("Baking sky light and bounced light: %.0f %%%s", 100.0 * share,
             textOfTimeLeft(seconds_left).c_str());
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point latest_ = Clock::now();
};

}  // namespace

studio::Reports loggedReports() {
  studio::Reports reports;
  reports.note = [](const std::string& line) { ROS_INFO("%s", line.c_str()); };
  reports.warning = [](const std::string& line) { ROS_WARN("%s", line.c_str()); };
  reports.flaw = [](const std::string& line) {
    ROS_LOG(inputLevel(), ROSCONSOLE_DEFAULT_NAME, "%s", line.c_str());
  };
  reports.baking = BakeLog();
  return reports;
}

void PoseLog::report(int position, int positions) {
  const Clock::time_point now = Clock::now();
  if (begin_position_ < 0) {
    begin_position_ = position;
    begin_ = latest_ = now;
  }
  if (position == begin_position_) return;
  const double per_pose_s =
      std::chrono::duration<double>(now - begin_).count() / (position - begin_position_);
  seconds_left_ = per_pose_s * (positions - position);
  if (now - latest_ < kInterval && position < positions) return;
  latest_ = now;
  ROS_INFO("pose %d of %d (%d %%), %.0f ms a pose, %s left", position, positions, 100 * position / positions,
           1e3 * per_pose_s, textOfDuration(seconds_left_).c_str());
}

bool WaitLog::report(const Wait& waits_for) {
  const double now_s = clock_();
  if (waits_for.key != key_) begin_s_ = now_s;
  key_ = waits_for.key;
  if (waits_for.empty() || now_s - begin_s_ < kPatience_s) return false;
  if (!latest_s_ || now_s - *latest_s_ >= std::chrono::duration<double>(kInterval).count()) {
    latest_s_ = now_s;
    const bool is_usual = now_s - begin_s_ < kUsual_s;
    ROS_LOG(is_usual ? ros::console::levels::Info : ros::console::levels::Warn, ROSCONSOLE_DEFAULT_NAME,
            "Waiting for %s", waits_for.words.c_str());
  }
  return true;
}

}  // namespace sunlit::ros_interface
