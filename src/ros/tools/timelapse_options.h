/// The command line of `timelapse`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ros/tools/pictures_of_day.h"
#include "ros/tools/sky_of_instant.h"
#include "ros/tools/view_arguments.h"

namespace sunlit::tools {

/// What is written into each frame.
enum class Caption { kNone, kHour, kFull };

struct TimelapseOptions {
  ViewOptions view;
  PlaceOptions place;
  double from_hour = 0.0;   ///< of the day, −24 … 48
  double step_hours = 0.5;  ///< > 0
  int frames = 48;          ///< > 0
  Caption caption = Caption::kNone;
  std::string output;         ///< folder
  std::string video;          ///< empty: none
  double frame_rate = 25.0;   ///< Hz, of the video
  std::string contact_sheet;  ///< empty: none
  SheetLayout sheet;
  std::vector<std::string> recipe;  ///< what decides how frames look: options, contents of files

  double hourOf(int frame) const { return from_hour + frame * step_hours; }
};

/// Prints what `--help` asks for.
void printTimelapseHelp();

/// Empty if help was asked for. Throws std::invalid_argument naming the option, its value and what is
/// allowed.
std::optional<TimelapseOptions> parseTimelapseOptions(const std::vector<std::string>& arguments);

}  // namespace sunlit::tools
