/// run.yaml: what was asked for, with which versions, and what came of it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sunlit/evaluate/run/evaluation.h"

namespace sunlit::evaluate {

/// Everything that decides what a value in frames.csv is, as key and value. The keys are the evaluator's
/// parameters.
using Settings = std::vector<std::pair<std::string, std::string>>;
Settings settingsOf(const EvaluationOptions& options);

/// Whether the run.yaml at `path` tells any settings.
bool holdsSettings(const std::string& path);

/// Throws std::invalid_argument, naming key and both values, where the run.yaml at `path` has other settings.
/// Nothing where there is none.
void requireSameSettings(const std::string& path, const Settings& settings);

/// The same of `folder`/run.yaml, but a run that ended before anything came binds nobody to its settings:
/// what it left is removed.
void claimFolder(const std::string& folder, const Settings& settings);

/// `outcome` may be null: the run is still going on; so may `localised`: nothing was to be localised, or not
/// yet.
void writeRunFile(const std::string& path, const EvaluationOptions& options, const Outcome* outcome,
                  const LocalisationOutcome* localised);

}  // namespace sunlit::evaluate
