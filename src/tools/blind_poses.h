/// Poses from which nothing of the world is in view, which pictures alone do not tell from fog or night.
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "sunlit/studio/studio.h"

namespace sunlit::tools {

/// On stderr, where `studio` looks at nothing; `where`, which ends with a space, begins the line. Returns
/// whether it does.
bool warnIfBlind(const studio::Studio& studio, const std::string& where = "");

/// Of a path's poses: the first is told at once, and how many there were at the end.
class BlindPoses {
 public:
  /// The pose that `studio` looks from.
  void check(const studio::Studio& studio, std::int64_t pose);
  void tell() const;

 private:
  std::set<std::int64_t> poses_;
};

}  // namespace sunlit::tools
