/// The world that a tool takes pictures of.
#pragma once

#include "ros/tools/world_arguments.h"
#include "sunlit/light/world.h"

namespace sunlit::tools {

/// Loads it, and bakes how light spreads in it or reads that from the cache, if the options ask for it.
/// Warnings and progress go to stderr. Throws what scene::load() and light::Transport throw.
light::World loadWorld(const WorldOptions& options);

}  // namespace sunlit::tools
