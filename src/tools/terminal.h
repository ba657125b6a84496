/// What a tool tells the person at the terminal while it works.
#pragma once

#include "sunlit/studio/reports.h"

namespace sunlit::tools {

/// Warnings, and one line for a bake that takes longer than a moment, on stderr, below the first note, which
/// is of the world and its extents. All other notes are left out.
studio::Reports onTerminal();

}  // namespace sunlit::tools
