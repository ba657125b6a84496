/// Folders that tools write into.
#pragma once

#include <string>

namespace sunlit::tools {

/// Throws std::runtime_error "folder: what: why" where it is not there and cannot be made either, as far as
/// can be told without making it.
void requireFolderCanBeMade(const std::string& folder);

/// The first of what `folder` holds, by name; empty if there is nothing. What is still being written does not
/// count: another process may just be at it.
std::string anythingIn(const std::string& folder);

}  // namespace sunlit::tools
