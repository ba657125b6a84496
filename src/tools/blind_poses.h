/// Poses that look from under the ground, or at nothing of the world, which pictures alone do not tell from
/// fog or night.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "sunlit/studio/studio.h"

namespace sunlit::tools {

/// On stderr, where something is amiss with what `studio` looks at. Returns whether it is.
bool warnIfBlind(const studio::Studio& studio);

/// Of a path's poses: the first of a kind is told at once, and how many there were at the end.
class BlindPoses {
 public:
  /// The pose that `studio` looks from.
  void check(const studio::Studio& studio, std::int64_t pose);
  void tell() const;

 private:
  std::map<std::string, std::set<std::int64_t>> poses_;  ///< by what they do
};

}  // namespace sunlit::tools
