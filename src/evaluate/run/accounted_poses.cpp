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
  numbers_.erase(pose);
  beyond_.erase(pose);
  pass();
}

void AccountedPoses::addNumber(std::int64_t number) {
  const bool is_pose = has(number) && numbers_.count(number) == 0;
  add(number);
  if (!is_pose) numbers_.insert(number);
}

void AccountedPoses::forgetNumbers() {
  passed_before_ = passed();
  for (const std::int64_t number : numbers_) {
    all_.erase(number);
    if (!expected_.holds(number)) --unexpected_;
  }
  numbers_.clear();
  leading_ = 0;
  pass();
}

void AccountedPoses::pass() {
  while (leading_ < expected_.size() && has(expected_.at(leading_))) ++leading_;
  const bool is_whole = leading_ == expected_.size();
  beyond_.erase(beyond_.begin(), is_whole ? beyond_.end() : beyond_.lower_bound(expected_.at(leading_)));
}

}  // namespace sunlit::evaluate
