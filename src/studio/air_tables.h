/// Tables of the air on disk.
#pragma once

#include <filesystem>

#include "sunlit/sky/table_store.h"
#include "sunlit/studio/reports.h"

namespace sunlit::studio {

/// Kept in `folder`, as image::CacheFolder has it, up to 100 MB of them. Whole or not at all; what is damaged
/// is made anew. Warns where they cannot be kept.
sky::TableStore airTablesIn(const std::filesystem::path& folder, const Reports& reports);

}  // namespace sunlit::studio
