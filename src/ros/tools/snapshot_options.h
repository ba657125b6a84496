/// The command line of `snapshot`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ros/tools/sky_of_instant.h"
#include "ros/tools/view_arguments.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::tools {

struct SnapshotOptions {
  ViewOptions view;
  PlaceOptions place;
  std::optional<double> hour;                 ///< set: the sky of that hour over `place`
  Angle sun_azimuth = Angle::degrees(180.0);  ///< compass; of a sun alone, where there is no hour
  Angle sun_elevation = Angle::degrees(40.0);
  std::string output;
  std::string depth_output;  ///< empty: none
};

/// Prints what `--help` asks for.
void printSnapshotHelp();

/// Empty if help was asked for. Throws std::invalid_argument naming the option, its value and what is
/// allowed.
std::optional<SnapshotOptions> parseSnapshotOptions(const std::vector<std::string>& arguments);

}  // namespace sunlit::tools
