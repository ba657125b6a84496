/// Command line options that say which world, shared by all tools; and how light spreads in it, shared by
/// those that light it.
#pragma once

#include "sunlit/studio/world.h"
#include "tools/command_line.h"

namespace sunlit::tools {

/// --world and --model-path.
void addWorld(CommandLine* line, studio::WorldOptions* options);
/// --bounced and --cache.
void addBounced(CommandLine* line, studio::BakeOptions* options);

}  // namespace sunlit::tools
