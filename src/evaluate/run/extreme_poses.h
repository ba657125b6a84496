/// Of one pair and detector: the poses with the fewest and those with the most right matches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>

#include "sunlit/evaluate/verify/verify.h"

namespace sunlit::evaluate {

/// So many of either.
constexpr std::size_t kExtremePoses = 2;

/// Of those matches that pass the ratio test; 0 where none does.
std::int64_t rightMatches(const Verified& verified);

/// Of equally many the lower poses are kept, so that the order in which they come decides nothing.
class ExtremePoses {
 public:
  /// It would be among them now. What never would is none of the last.
  bool takes(std::int64_t right, std::int64_t pose) const;
  void add(std::int64_t right, std::int64_t pose);
  bool has(std::int64_t pose) const;
  std::set<std::int64_t> poses() const;

 private:
  using Ranked = std::set<std::pair<std::int64_t, std::int64_t>>;  // what they are ranked by, and the pose
  Ranked fewest_;
  Ranked most_;  // by less right matches than none
};

}  // namespace sunlit::evaluate
