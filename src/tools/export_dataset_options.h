/// The command line of `export_dataset`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sunlit/evaluate/data_sets/data_set.h"
#include "sunlit/quantity/field.h"
#include "sunlit/studio/studio.h"
#include "tools/place_arguments.h"
#include "tools/time_of_day.h"

namespace sunlit::tools {

struct ExportOptions {
  studio::StudioOptions studio;
  PlaceOptions place;
  std::vector<TimeOfDay> hours = {TimeOfDay()};  ///< one or more, all different
  std::vector<evaluate::DataSetFormat> formats;  ///< likewise
  double rate_hz = 10.0;                         ///< of the poses of the whole path
  evaluate::DataSetOptions data_set;             ///< of the poses that are taken
  std::vector<evaluate::DataSetFrame> frames;    ///< one or more
  std::vector<Motion> motions;                   ///< of the camera, one a frame
  std::string output;                            ///< folder
  std::vector<std::string> recipe;               ///< what decides what is written

  /// Of one hour and format: OUTPUT, with a folder below it for each hour and each format where there are
  /// several.
  std::string folderOf(const TimeOfDay& hour, evaluate::DataSetFormat format) const;
};

/// Empty if help was asked for, and has been printed. Throws std::invalid_argument naming the option, its
/// value and what is allowed, and what posesOf() throws.
std::optional<ExportOptions> parseExportOptions(const std::vector<std::string>& arguments);

}  // namespace sunlit::tools
