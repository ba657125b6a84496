#include "evaluate/run/accounted_poses.h"

namespace sunlit::evaluate {

void AccountedPoses::insert(std::int64_t pose) {
  if (all_.insert(pose).second && !expected_.holds(pose)) ++unexpected_;
}

// Where nobody said which are expected, nobody knows of a hole.
void AccountedPoses::takeUp(std::int64_t pose) {
  insert(pose);
  if (expected_.size() > 0) beyond_.insert(pose);
  pass();
}

// One that a sender sends beyond a hole it has passed, and does not wait for.
void AccountedPoses::add(std::int64_t pose) {
  insert(pose);
  beyond_.erase(pose);
  pass();
}

void AccountedPoses::pass() {
  while (leading_ < expected_.size() && has(expected_.at(leading_))) ++leading_;
  const bool is_whole = leading_ == expected_.size();
  beyond_.erase(beyond_.begin(), is_whole ? beyond_.end() : beyond_.lower_bound(expected_.at(leading_)));
}

}  // namespace sunlit::evaluate
