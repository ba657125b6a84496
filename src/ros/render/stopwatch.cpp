#include "ros/render/stopwatch.h"

namespace sunlit::ros_interface {

Stopwatch::Charge::~Charge() {
  const std::lock_guard<std::mutex> lock(watch.mutex_);
  Entry& account = watch.entry(stage, what);
  account.count += 1;
  account.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

Stopwatch::Entry& Stopwatch::entry(const std::string& stage, const std::string& what) {
  for (Entry& known : entries_) {
    if (known.stage == stage && known.what == what) return known;
  }
  entries_.push_back({stage, what, 0, 0.0});
  return entries_.back();
}

void Stopwatch::write(std::ostream& out) const {
  out << "stage,what,count,seconds\n";
  for (const Entry& account : entries_) {
    out << account.stage << ',' << account.what << ',' << account.count << ',' << account.seconds << '\n';
  }
}

}  // namespace sunlit::ros_interface
