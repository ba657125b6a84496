/// The command line of `timelapse`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sunlit/image/picture_series.h"
#include "sunlit/quantity/field.h"
#include "tools/place_arguments.h"
#include "tools/view_arguments.h"

namespace sunlit::tools {

/// What is written into each frame.
enum class Caption { kNone, kHour, kFull };

struct TimelapseOptions {
  ViewOptions view;
  PlaceOptions place;
  double from_hour = 0.0;   ///< of the day
  double step_hours = 0.5;  ///< > 0
  int frames = 48;
  Caption caption = Caption::kNone;
  std::string output;         ///< folder
  std::string video;          ///< empty: none
  double frame_rate = 25.0;   ///< Hz, of the video
  std::string contact_sheet;  ///< empty: none
  image::SheetLayout sheet;
  std::vector<std::string> recipe;  ///< what decides how frames look: options, contents of files

  double hourOf(int frame) const { return from_hour + frame * step_hours; }
};

/// But for the hours: step and number of frames follow from one another.
inline std::vector<Field> fieldsOf(TimelapseOptions& options) {
  return {
      {"out",
       &options.output,
       "",
       {},
       "folder for the frames: frame_00000.png ... A broken off run goes on where it was; timelapse.txt "
       "beside them says how they were made, and other options need another folder"},
      {"from", &options.from_hour, "h", {-24, 48}, "first frame, hour of the day"},
      {"caption",
       choiceOf(&options.caption, {"none", "hour", "full"}),
       "",
       {},
       "written into the frames; full adds the sun's elevation and the light on level ground"},
      {"video",
       &options.video,
       "",
       {},
       "a film of the frames too: .mp4 (H.264), .avi (Motion JPEG) or .mkv (FFV1, lossless)"},
      {"fps", &options.frame_rate, "Hz", {1, 120}, "of that film"},
      {"contact-sheet",
       &options.contact_sheet,
       "",
       {},
       "all frames side by side, at most " + std::to_string(image::kLongestSheetSide) + " px wide and high"},
      {"columns", &options.sheet.columns, "", {1, 100}, "of that sheet"},
      {"thumbnail", &options.sheet.width_px, "px", {16, 8192}, "width of its pictures"}};
}

/// Empty if help was asked for, and has been printed. Throws std::invalid_argument naming the option, its
/// value and what is allowed.
std::optional<TimelapseOptions> parseTimelapseOptions(const std::vector<std::string>& arguments);

}  // namespace sunlit::tools
