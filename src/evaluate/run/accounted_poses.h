/// Which poses are accounted for.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>

#include "sunlit/evaluate/run/pose_range.h"

namespace sunlit::evaluate {

/// A sender goes by the number of poses that its reader is done with: it counts those before the one that it
/// is at. Poses that an earlier run left beyond a hole are none of them, until the hole is mended.
class AccountedPoses {
 public:
  explicit AccountedPoses(const PoseRange& expected) : expected_(expected) {}

  /// An earlier run left all that is wanted of it.
  void takeUp(std::int64_t pose);
  /// This run is done with it.
  void add(std::int64_t pose);
  /// The same of a number that stands for a pose until forgetNumbers().
  void addNumber(std::int64_t number);
  /// Numbers turned out to be no poses.
  void forgetNumbers();

  bool has(std::int64_t pose) const { return all_.count(pose) != 0; }
  std::size_t size() const { return all_.size(); }
  /// Of them: not among those expected.
  std::size_t unexpected() const { return unexpected_; }
  /// Of them: expected.
  std::size_t expected() const { return all_.size() - unexpected_; }
  /// Whether all that are expected are; never where their number is unknown.
  bool isWhole() const { return expected_.size() > 0 && expected() >= expected_.size(); }
  /// How many a sender may count as done: never fewer than before, and all of them once it is whole.
  std::size_t passed() const { return std::max(all_.size() - beyond_.size(), passed_before_); }

 private:
  void insert(std::int64_t pose);
  void pass();

  PoseRange expected_;
  std::set<std::int64_t> all_;
  std::set<std::int64_t> beyond_;   // of them: taken up, and beyond a hole
  std::set<std::int64_t> numbers_;  // of them: by addNumber() alone
  std::size_t passed_before_ = 0;   // forgetNumbers()
  std::size_t unexpected_ = 0;
  std::size_t leading_ = 0;  // of those expected, without a hole
};

}  // namespace sunlit::evaluate
