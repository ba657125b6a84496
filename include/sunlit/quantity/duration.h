/// How long something takes, in words.
#pragma once

#include <string>

namespace sunlit {

/// "59 s", "1 min 04 s", "2 h 01 min", of whole seconds; `seconds` ≥ 0. What experiments say of themselves,
/// in scripts/sunlit_experiment/progress.py, reads alike.
std::string textOfDuration(double seconds);

/// What goes on "40 %": ", 12 s left"; nothing for NaN, where nobody can tell yet.
std::string textOfTimeLeft(double seconds);

}  // namespace sunlit
