/// Of one pair and detector: the poses with the fewest and those with the most right matches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "sunlit/evaluate/verify/verify.h"

namespace sunlit::evaluate {

/// So many of either.
constexpr std::size_t kExtremePoses = 2;

/// Of those matches that pass the ratio test; 0 where none does.
std::int64_t rightMatches(const Verified& verified);

/// Of equally many the earlier ones are kept, so that neither the order in which they come nor numbers that
/// are settled at the end decide anything.
class ExtremePoses {
 public:
  /// It would be among them now. What never would is none of the last.
  bool takes(std::int64_t right, std::int64_t stamp_ns) const;
  void add(std::int64_t right, std::int64_t stamp_ns, std::int64_t pose);
  bool has(std::int64_t pose) const;
  std::set<std::int64_t> poses() const;

 private:
  /// Poses by what they are ranked by, and their stamp.
  using Ranked = std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t>;
  Ranked fewest_;
  Ranked most_;  // by less right matches than none
};

}  // namespace sunlit::evaluate
