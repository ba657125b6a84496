#include "tools/timelapse_options.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "sunlit/studio/command_line.h"
#include "tools/frame_folder.h"
#include "tools/recipe.h"

namespace sunlit::tools {

namespace {

constexpr int kMostFrames = 100000;

struct Span {
  double to_hour = 24.0;
  double step_minutes = 30.0;
  int frames = 0;  ///< 0: by the step
};

void addOutput(studio::CommandLine* line, TimelapseOptions* options) {
  const std::vector<Field> rows = fieldsOf(*options);
  line->group("Output");
  line->add("--out FOLDER", fieldOf(rows, "out"));
  line->add("--caption", fieldOf(rows, "caption"));
  line->add("--video FILE", fieldOf(rows, "video"))
      .then([](const std::string& option, const std::string& file) { image::requireFilmName(option, file); });
  line->add("--fps NUMBER", fieldOf(rows, "fps"));
  line->add("--contact-sheet FILE.png", fieldOf(rows, "contact-sheet"))
      .then([](const std::string& option, const std::string& file) {
        studio::requireEnding(option, file, ".png");
      });
  line->add("--columns N", fieldOf(rows, "columns"));
  line->add("--thumbnail WIDTH", fieldOf(rows, "thumbnail"));
}

void addTime(studio::CommandLine* line, TimelapseOptions* options, Span* span) {
  line->group("Time");
  line->add("--from HOUR", fieldOf(fieldsOf(*options), "from"));
  line->add("--to HOUR", {"to", &span->to_hour, "h", {-24, 72}, "end, itself not shown"});
  line->add("--step MINUTES", {"step", &span->step_minutes, "min", {1e-3, 1440}, "between two frames"});
  line->add("--frames N",
            {"frames", &span->frames, "", {1, kMostFrames}, "so many, evenly spread, instead of --step"})
      .withoutDefault();
}

/// Throws for words that do not go together.
void divide(const Span& span, TimelapseOptions* options) {
  const double hours = span.to_hour - options->from_hour;
  if (!(hours > 0.0)) throw std::invalid_argument("--to must be later than --from");
  if (span.frames > 0) {
    options->frames = span.frames;
    options->step_hours = hours / span.frames;
    return;
  }
  options->step_hours = span.step_minutes / 60.0;
  // A last frame that rounding would put just before the end is at the end.
  const double frames = std::ceil(hours / options->step_hours - 1e-9);
  if (frames > kMostFrames)
    throw std::invalid_argument("--step would make more than " + std::to_string(kMostFrames) + " frames");
  options->frames = static_cast<int>(frames);
}

void requireSensibleSheet(const TimelapseOptions& options) {
  if (options.contact_sheet.empty()) return;
  const image::PinholeCamera& camera = options.view.studio.render.camera;
  const image::PictureSize size =
      image::sheetSize(options.sheet, options.frames, 1.0 * camera.height / camera.width);
  if (std::max(size.width, size.height) <= image::kLongestSheetSide) return;
  throw std::invalid_argument("--contact-sheet would be " + std::to_string(size.width) + " x " +
                              std::to_string(size.height) + " px, must be at most " +
                              std::to_string(image::kLongestSheetSide) +
                              " px wide and high; fewer frames, a smaller --thumbnail or other --columns");
}

/// Throws unless `file`, where it is named, can be written: its folder is there, or will be made.
void requireRoomFor(const std::string& option, const std::string& file, const std::string& output) {
  namespace fs = std::filesystem;
  // Whichever way they are spelt; with a slash at the end.
  const auto spelt = [](const fs::path& folder) {
    return (fs::weakly_canonical(fs::absolute(folder)) / "").lexically_normal();
  };
  if (spelt(fs::absolute(file).parent_path()) != spelt(output)) return studio::requireFolderOf(option, file);
  if (isFrame(fs::path(file).filename().string()))
    throw std::invalid_argument(option + " is " + file +
                                ", but must be another file than the frames in --out");
}

/// Options that do not change what frames look like.
const std::set<std::string> kOfNoFrame = {"--cache",         "--out",     "--video",    "--fps",
                                          "--contact-sheet", "--columns", "--thumbnail"};

}  // namespace

std::optional<TimelapseOptions> parseTimelapseOptions(const std::vector<std::string>& arguments) {
  TimelapseOptions options;
  Span span;
  studio::CommandLine line(
      "timelapse: a day as one camera sees it, under sun, moon and stars. Needs no ROS master.",
      "timelapse --out FOLDER [options]");
  addOutput(&line, &options);
  addTime(&line, &options, &span);
  addPlace(&line, &options.place);
  const ViewArguments view(&line);
  if (!line.read(arguments)) return std::nullopt;
  requireWeather(line, options.place.weather, options.place.surfaces, airOf(options.place));
  if (!line.has("--out")) throw std::invalid_argument("--out FOLDER is missing; --help lists all options");
  if (line.has("--video")) requireRoomFor("--video", options.video, options.output);
  if (line.has("--contact-sheet")) requireRoomFor("--contact-sheet", options.contact_sheet, options.output);
  line.requireWith("--fps", {"--video"});
  line.requireWith("--columns", {"--contact-sheet"});
  line.requireWith("--thumbnail", {"--contact-sheet"});
  if (line.has("--frames") && line.has("--step"))
    throw std::invalid_argument("--frames and --step are both given; one of them");
  divide(span, &options);
  options.view = view.options(options.place.weather);
  options.view.studio.surfaces = {options.place.surfaces};
  requireSensibleSheet(options);
  options.recipe = recipeOf(line, {kOfNoFrame, {"--path", "--calibration"}}, options.view.studio.world);
  tellOfPlace(line, options.place, options.view.studio.world);
  return options;
}

}  // namespace sunlit::tools
