/// Command line options that say which world, shared by all tools; and how light spreads in it, shared by
/// those that light it.
#pragma once

#include "sunlit/studio/command_line.h"
#include "sunlit/studio/world.h"

namespace sunlit::tools {

/// --world, --model-path and --missing.
void addWorld(studio::CommandLine* line, studio::WorldOptions* options);
/// --bounced and --cache.
void addBounced(studio::CommandLine* line, studio::BakeOptions* options);

/// --lamps and what tells which and when.
void addLamps(studio::CommandLine* line, light::LampOptions* options);

}  // namespace sunlit::tools
