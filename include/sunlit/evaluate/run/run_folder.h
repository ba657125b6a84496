/// Whose a folder of results is.
#pragma once

#include <string>

namespace sunlit::evaluate {

/// More than a run leaves that ended before anything came.
bool holdsResults(const std::string& folder);

/// Throws std::invalid_argument, naming it, where `folder` holds what an Evaluation found: what others write
/// there would be taken for the results of the same images, or stand in their place.
void requireNoRun(const std::string& folder);

}  // namespace sunlit::evaluate
