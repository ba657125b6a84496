/// An atlas as jobs of a Slurm cluster.
#pragma once

#include "tools/atlas_folder.h"
#include "tools/atlas_options.h"

namespace sunlit::tools {

/// Writes observe.sh, compare.sh and merge.sh into FOLDER/slurm, and hands them to sbatch unless told not to:
/// arrays of as many tasks as there are units, options.slurm->tasks at most, each once the one before has
/// gone well. Throws std::runtime_error where sbatch refuses one.
void runBySlurm(const AtlasRunOptions& options, const AtlasFolder& folder);

}  // namespace sunlit::tools
