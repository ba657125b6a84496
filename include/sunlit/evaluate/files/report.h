/// The page of an output folder.
#pragma once

#include <string>

#include "sunlit/evaluate/stop_token.h"

namespace sunlit::evaluate {

/// What of the report's own words is shown on standard output.
enum class ReportTables { kShown, kHidden };

/// Draws report.html of `folder`, and what else of an atlas, by the program `report`: that beside this
/// program where both are installed, else that which rosrun finds. Waits for it. False where it does not end
/// well; why, it says on standard error itself. Throws Stopped once it is no longer wanted, and has ended
/// then.
bool drawReport(const std::string& folder, ReportTables tables, const StopToken& stop = {});

}  // namespace sunlit::evaluate
