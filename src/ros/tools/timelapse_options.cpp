#include "ros/tools/timelapse_options.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "ros/tools/arguments.h"
#include "ros/tools/pictures_of_day.h"

namespace sunlit::tools {

namespace {

constexpr int kMostFrames = 100000;

constexpr const char* kOwnHelp =
    R"(timelapse: a day as one camera sees it, under sun, moon and stars. Needs no ROS master.

usage: timelapse --out FOLDER [options]

  --out FOLDER                   for the frames: frame_00000.png ... A broken off run goes on where it was; whole frames
                                 are kept as long as the options are the same
  --from HOUR                    first frame, hours of the day, -24 ... 48 (default 0)
  --to HOUR                      end, itself not shown (default 24)
  --step MINUTES                 between two frames (default 30)
  --frames N                     so many, evenly spread, instead of --step
  --caption none|hour|full       written into the frames; full adds the sun's elevation and the light on level ground
                                 (default none)
  --video FILE                   a film of the frames too: .mp4 (H.264), .avi (Motion JPEG) or .mkv (FFV1, lossless)
  --fps NUMBER                   of that film, 1 ... 120 (default 25)
  --contact-sheet FILE.png       all frames side by side
  --columns N                    of that sheet, 1 ... 100 (default 6)
  --thumbnail WIDTH              of its pictures, 16 ... 8192 px (default 320)
)";

struct Span {
  double to_hour = 24.0;
  std::optional<double> step_minutes;
  std::optional<int> frames;
};

bool takeTime(const std::string& key, const std::string& value, TimelapseOptions* options, Span* span) {
  if (key == "--from") {
    options->from_hour = numberWithin(key, value, -24.0, 48.0);
  } else if (key == "--to") {
    span->to_hour = numberWithin(key, value, -24.0, 72.0);
  } else if (key == "--step") {
    span->step_minutes = numberWithin(key, value, 1e-3, 1440.0);
  } else if (key == "--frames") {
    span->frames = wholeWithin(key, value, 1, kMostFrames);
  } else {
    return false;
  }
  return true;
}

/// The options that do not change what frames look like.
bool takeOutput(const std::string& key, const std::string& value, TimelapseOptions* options) {
  if (key == "--out") {
    options->output = value;
  } else if (key == "--video") {
    requireVideoName(value);
    options->video = value;
  } else if (key == "--fps") {
    options->frame_rate = numberWithin(key, value, 1.0, 120.0);
  } else if (key == "--contact-sheet") {
    requireEnding(key, value, ".png");
    options->contact_sheet = value;
  } else if (key == "--columns") {
    options->columns = wholeWithin(key, value, 1, 100);
  } else if (key == "--thumbnail") {
    options->thumbnail_width = wholeWithin(key, value, 16, 8192);
  } else {
    return false;
  }
  return true;
}

bool takeCaption(const std::string& key, const std::string& value, TimelapseOptions* options) {
  if (key != "--caption") return false;
  if (value == "none") {
    options->caption = Caption::kNone;
  } else if (value == "hour") {
    options->caption = Caption::kHour;
  } else if (value == "full") {
    options->caption = Caption::kFull;
  } else {
    reject(key, value, "none, hour or full");
  }
  return true;
}

void divide(const Span& span, TimelapseOptions* options) {
  const double hours = span.to_hour - options->from_hour;
  if (!(hours > 0.0)) throw std::invalid_argument("--to must be later than --from");
  if (span.frames && span.step_minutes)
    throw std::invalid_argument("--frames and --step are both given; one of them");
  if (span.frames) {
    options->frames = *span.frames;
    options->step_hours = hours / *span.frames;
    return;
  }
  options->step_hours = span.step_minutes.value_or(30.0) / 60.0;
  // A last frame that rounding would put just before the end is at the end.
  const double frames = std::ceil(hours / options->step_hours - 1e-9);
  if (frames > kMostFrames)
    throw std::invalid_argument("--step would make more than " + std::to_string(kMostFrames) + " frames");
  options->frames = static_cast<int>(frames);
}

}  // namespace

void printTimelapseHelp() {
  std::fputs(kOwnHelp, stdout);
  std::fputs(kPlaceHelp, stdout);
  std::fputs(kViewHelp, stdout);
}

std::optional<TimelapseOptions> parseTimelapseOptions(const std::vector<std::string>& arguments) {
  TimelapseOptions options;
  ViewArguments view;
  PlaceArguments place;
  Span span;
  const bool go = readArguments(arguments, [&](const std::string& key, const std::string& value) {
    if (takeOutput(key, value, &options)) return true;
    if (key != "--cache") options.recipe.push_back(key + ' ' + value);
    return takeTime(key, value, &options, &span) || takeCaption(key, value, &options) ||
           place.take(key, value) || view.take(key, value);
  });
  if (!go) return std::nullopt;
  if (options.output.empty())
    throw std::invalid_argument("--out FOLDER is missing; --help lists all options");
  divide(span, &options);
  options.view = view.options();
  options.place = place.options();
  std::sort(options.recipe.begin(), options.recipe.end());
  return options;
}

}  // namespace sunlit::tools
