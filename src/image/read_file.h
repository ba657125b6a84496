/// Whole files into memory.
#pragma once

#include <string>

namespace sunlit::image {

/// Throws std::runtime_error with path and reason.
std::string readWholeFile(const std::string& path);

}  // namespace sunlit::image
