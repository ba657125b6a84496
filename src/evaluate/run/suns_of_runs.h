/// Whether runs that are merged were under the same suns.
#pragma once

#include "sunlit/evaluate/run/evaluation_options.h"

namespace sunlit::evaluate {

/// Throws std::invalid_argument naming folder, stream and difference where captures.csv of a folder that is
/// merged tells of another sun than those before it, the first of which is output_dir.
void requireOneSun(const EvaluationOptions& options);

}  // namespace sunlit::evaluate
