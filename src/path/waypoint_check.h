/// What must be true of waypoints, in one place for lists and files.
#pragma once

#include <optional>
#include <string>

#include "sunlit/path/path.h"

namespace sunlit::path {

/// Too near to each other in plan view to give a heading.
bool areTooNear(const Eigen::Vector3d& point, const Eigen::Vector3d& previous);

/// What is wrong with `point`, which follows `previous` (null for the first): nothing, or a sentence about
/// it.
std::optional<std::string> faultOf(const Eigen::Vector3d& point, const Eigen::Vector3d* previous);

/// What a list of `count` waypoints, too few, is told.
std::string tooFew(std::size_t count);

}  // namespace sunlit::path
