/// Command line options of detectors, shared by the tools that find features.
#pragma once

#include "sunlit/evaluate/verify/verify.h"
#include "sunlit/studio/command_line.h"

namespace sunlit::tools {

/// "--sift-n-features" of the row "features/sift/n_features", "--clahe-tiles" of "preprocessing/clahe/tiles".
std::string optionOf(const std::string& key);

/// --detectors, --ratio and --inclusive.
void addMatching(studio::CommandLine* line, evaluate::VerifyOptions* options);
/// The parameters of all detectors and preprocessings, in groups of their own.
void addDetectors(studio::CommandLine* line, evaluate::VerifyOptions* options);

}  // namespace sunlit::tools
