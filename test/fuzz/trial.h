/// What of a test differs by reader.
#pragma once

#include <cstddef>

namespace sunlit::fuzz {

struct Trial {
  const char* reader;
  std::size_t cases;  ///< so many inputs are made
};

/// Defined by the build, once in each program.
extern const Trial kTrial;

}  // namespace sunlit::fuzz
