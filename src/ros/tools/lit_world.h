/// The world that a tool takes pictures of.
#pragma once

#include "ros/tools/view_arguments.h"
#include "sunlit/light/world.h"

namespace sunlit::tools {

/// Loads it, and bakes how light spreads in it or reads that from the cache, if ViewOptions asks for it.
/// Warnings and progress go to stderr. Throws what scene::load() and light::Transport throw.
light::World loadWorld(const ViewOptions& view);

}  // namespace sunlit::tools
