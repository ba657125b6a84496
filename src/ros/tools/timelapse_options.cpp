#include "ros/tools/timelapse_options.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

#include "ros/tools/arguments.h"
#include "ros/tools/pictures_of_day.h"
#include "sunlit/quantity/fingerprint.h"
#include "sunlit/scene/load.h"

namespace sunlit::tools {

namespace {

constexpr int kMostFrames = 100000;

constexpr const char* kOwnHelp =
    R"(timelapse: a day as one camera sees it, under sun, moon and stars. Needs no ROS master.

usage: timelapse --out FOLDER [options]

  --out FOLDER                   for the frames: frame_00000.png ... A broken off run goes on where it was; timelapse.txt
                                 beside them says how they were made, and other options need another folder
  --from HOUR                    first frame, hours of the day, -24 ... 48 (default 0)
  --to HOUR                      end, itself not shown (default 24)
  --step MINUTES                 between two frames (default 30)
  --frames N                     so many, evenly spread, instead of --step
  --caption none|hour|full       written into the frames; full adds the sun's elevation and the light on level ground
                                 (default none)
  --video FILE                   a film of the frames too: .mp4 (H.264), .avi (Motion JPEG) or .mkv (FFV1, lossless)
  --fps NUMBER                   of that film, 1 ... 120 (default 25)
  --contact-sheet FILE.png       all frames side by side, at most 16384 px wide and high
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
    requireFolderOf(key, value);
    options->video = value;
  } else if (key == "--fps") {
    options->frame_rate = numberWithin(key, value, 1.0, 120.0);
  } else if (key == "--contact-sheet") {
    requireFile(key, value, ".png");
    options->contact_sheet = value;
  } else if (key == "--columns") {
    options->sheet.columns = wholeWithin(key, value, 1, 100);
  } else if (key == "--thumbnail") {
    options->sheet.width_px = wholeWithin(key, value, 16, 8192);
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

/// Throws for an option that the lack of another one makes meaningless.
void requireThatAllCount(const std::set<std::string>& given) {
  const auto needs = [&](const char* option, const char* other) {
    if (given.count(option) != 0 && given.count(other) == 0)
      throw std::invalid_argument(std::string(option) + " needs " + other + " too");
  };
  needs("--fps", "--video");
  needs("--columns", "--contact-sheet");
  needs("--thumbnail", "--contact-sheet");
}

void requireSensibleSheet(const TimelapseOptions& options) {
  if (options.contact_sheet.empty()) return;
  const image::PinholeCamera& camera = options.view.render.camera;
  const PictureSize size = sheetSize(options.sheet, options.frames, 1.0 * camera.height / camera.width);
  if (std::max(size.width, size.height) <= kLongestSheetSide) return;
  throw std::invalid_argument("--contact-sheet would be " + std::to_string(size.width) + " x " +
                              std::to_string(size.height) + " px, must be at most " +
                              std::to_string(kLongestSheetSide) +
                              " px wide and high; fewer frames, a smaller --thumbnail or other --columns");
}

/// A file may change while its name stays.
std::string contentOf(const std::string& what, const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  Fingerprint print;
  for (std::istreambuf_iterator<char> byte(stream), end; byte != end; ++byte)
    print.add(static_cast<unsigned char>(*byte));
  return what + ' ' + print.text();
}

/// Sorted by options; one that may be repeated keeps its order.
std::vector<std::string> recipeOf(const std::vector<std::pair<std::string, std::string>>& given,
                                  const TimelapseOptions& options) {
  auto sorted = given;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> recipe;
  for (const auto& [option, value] : sorted) {
    recipe.push_back(option + ' ' + value);
    if (option == "--path") recipe.push_back(contentOf("content of the path", value));
  }
  if (options.view.world.name != scene::kRaceTrack)
    recipe.push_back(contentOf("content of the world", options.view.world.name));
  return recipe;
}

}  // namespace

void printTimelapseHelp() {
  std::fputs(kOwnHelp, stdout);
  std::fputs(kPlaceHelp, stdout);
  std::fputs(viewHelp().c_str(), stdout);
}

std::optional<TimelapseOptions> parseTimelapseOptions(const std::vector<std::string>& arguments) {
  TimelapseOptions options;
  ViewArguments view;
  PlaceArguments place;
  Span span;
  std::set<std::string> all;
  std::vector<std::pair<std::string, std::string>> of_frames;  // what they depend on
  const bool go = readArguments(arguments, [&](const std::string& key, const std::string& value) {
    all.insert(key);
    if (takeOutput(key, value, &options)) return true;
    if (key != "--cache") of_frames.emplace_back(key, value);
    return takeTime(key, value, &options, &span) || takeCaption(key, value, &options) ||
           place.take(key, value) || view.take(key, value);
  });
  if (!go) return std::nullopt;
  if (options.output.empty())
    throw std::invalid_argument("--out FOLDER is missing; --help lists all options");
  requireThatAllCount(all);
  divide(span, &options);
  options.view = view.options();
  options.place = place.options();
  requireSensibleSheet(options);
  options.recipe = recipeOf(of_frames, options);
  return options;
}

}  // namespace sunlit::tools
