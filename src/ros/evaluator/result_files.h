/// Names of what is written of bags that are localised or followed, and whose they are.
#pragma once

#include <set>
#include <string>

#include "ros/evaluator/bag_streams.h"

namespace sunlit::ros_interface {

inline constexpr const char* kLocalisationTable = "localisation.csv";
inline constexpr const char* kOdometryTable = "odometry.csv";

/// "truth_h20.tum".
std::string truthFile(const BagStream& stream);
/// "estimate_h20_orb.tum".
std::string estimateFile(const BagStream& stream, const std::string& detector);
/// "odometry_h20_orb.tum".
std::string odometryFile(const BagStream& stream, const std::string& detector);

/// Before any work: throws std::runtime_error for what is no folder, and std::invalid_argument, naming it and
/// a file, where `folder` holds such a table or trajectory that is not one of `own`: it would stand among
/// them as if it were of the same run.
void requireOnlyOwnResults(const std::string& folder, const std::set<std::string>& own);

}  // namespace sunlit::ros_interface
