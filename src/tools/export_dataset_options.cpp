#include "tools/export_dataset_options.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "sunlit/quantity/columns.h"
#include "tools/camera_arguments.h"
#include "tools/path_arguments.h"
#include "tools/recipe.h"
#include "tools/sensor_arguments.h"
#include "tools/world_arguments.h"

namespace sunlit::tools {

namespace {

using evaluate::DataSetFormat;
using evaluate::DataSetFrame;

/// Stamp of pose 0, as in experiments: a zero means "none" to some programs.
constexpr std::int64_t kStart_ns = 1000 * std::int64_t{1000000000};

/// What is typed before it is known what it is for.
struct Words {
  CameraWords camera;
  SensorWords sensor;
  PathWords path;
  std::optional<double> speed_m_s;  ///< nothing: from stamp to stamp
  std::vector<std::string> places;  ///< OUTPUT
};

Choices choicesOf(std::vector<DataSetFormat>* formats) {
  const std::vector<std::string>& names = evaluate::dataSetFormatNames();
  return {names,
          [=, &names] {
            std::vector<std::string> words;
            for (const DataSetFormat format : *formats)
              words.push_back(names[static_cast<std::size_t>(format)]);
            return words;
          },
          [=, &names](const std::vector<std::string>& words) {
            formats->clear();
            for (const std::string& word : words)
              formats->push_back(
                  static_cast<DataSetFormat>(std::find(names.begin(), names.end(), word) - names.begin()));
          }};
}

void addOwn(studio::CommandLine* line, ExportOptions* options) {
  line->group("Data set");
  line->add("--format FORMAT[,FORMAT...]", {"format",
                                            choicesOf(&options->formats),
                                            "",
                                            {},
                                            "tum (TUM RGB-D), euroc (EuRoC, mav0), colmap (text model with "
                                            "known poses, hloc); of several each "
                                            "has a folder of its own"})
      .withoutDefault();
  line->add(
          "--hours HOUR[,HOUR...]",
          {"hours", OwnForm{"12"}, "h", Range::below(0, 24),
           "of the day; of several each has a folder of its own, h04 ..., and each pose is drawn only once"})
      .then([options](const std::string& option, const std::string& text) {
        options->hours = timesOf(option, text);
      });
  line->add(
      "--rate HZ",
      {"rate", &options->rate_hz, "Hz", {0.001, 1000}, "pose k of the path has the stamp 1000 s + k / rate"});
  line->add("--depth-scale NUMBER", evaluate::depthScaleRow(&options->data_set.depth_scale));
  line->add("--baseline M",
            studio::explainedAs(image::baselineRow(&options->data_set.baseline_m),
                                "of euroc: to a right camera, cam1, like this one; 0: there is none"));
}

std::string outputOf(const std::vector<std::string>& places) {
  if (places.empty()) throw std::invalid_argument("OUTPUT is missing; --help lists all options");
  if (places.size() > 1)
    throw std::invalid_argument("OUTPUT is one folder, but there are " + places[0] + " and " + places[1]);
  return places[0];
}

/// What is taken, and how the camera moves meanwhile.
void layOut(const Words& words, ExportOptions* options) {
  const path::PoseSelection& selection = words.path.selection;
  const std::vector<Eigen::Isometry3d> poses = posesOf(words.path, options->studio.world);
  const int end = selection.end(static_cast<int>(poses.size()));
  for (int i = selection.first; i < end; i += selection.stride) {
    options->frames.push_back(
        {i, kStart_ns + path::nanosecondsTo(i, options->rate_hz), poses[static_cast<std::size_t>(i)]});
    options->motions.push_back(
        path::motionAt(poses, i, {options->rate_hz, words.speed_m_s, words.path.sampling.spacing_m}));
  }
}

/// Throws for words that do not go together.
void requireSense(const studio::CommandLine& line, const Words& words, const ExportOptions& options) {
  if (!line.has("--format"))
    throw std::invalid_argument("--format FORMAT is missing; --help lists all options");
  const bool has_steps = std::any_of(options.formats.begin(), options.formats.end(),
                                     [](DataSetFormat format) { return format != DataSetFormat::kColmap; });
  if (line.has("--depth-scale") && !has_steps)
    throw std::invalid_argument("--depth-scale is of tum and euroc; depth of colmap is in m, without steps");
  const bool has_right = std::any_of(options.formats.begin(), options.formats.end(),
                                     [](DataSetFormat format) { return format == DataSetFormat::kEuroc; });
  if (options.data_set.baseline_m > 0.0 && !has_right)
    throw std::invalid_argument("--baseline is of euroc; tum and colmap have one camera");
  if (line.has("--speed") && words.sensor.chain.shutter.none() &&
      !(options.place.weather.rain_mm_per_h > 0.0))
    throw std::invalid_argument(
        "--speed shows in pictures that take time, and in streaks of rain; give --line-delay, "
        "--exposure-time or --rain");
  words.sensor.requireSense(line);
  words.camera.requireSense(options.studio.bake);
}

}  // namespace

std::string ExportOptions::folderOf(const TimeOfDay& hour, DataSetFormat format) const {
  std::string folder = output;
  if (hours.size() > 1) folder += '/' + hour.name();
  if (formats.size() > 1) folder += '/' + evaluate::dataSetFormatNames()[static_cast<std::size_t>(format)];
  return folder;
}

std::optional<ExportOptions> parseExportOptions(const std::vector<std::string>& arguments) {
  ExportOptions options;
  Words words;
  studio::CommandLine line(
      "export_dataset: what a camera sees along a path, with depth, calibration and truth, in the files that "
      "other people's systems read. Needs no ROS master.",
      "export_dataset --format tum|euroc|colmap OUTPUT [options]");
  line.takeWords(&words.places);
  addOwn(&line, &options);
  addPath(&line, &words.path);
  addPlace(&line, &options.place);
  addCamera(&line, &words.camera);
  addSensor(&line, &words.sensor);
  addShutter(&line, &words.sensor);
  line.add("--speed auto|M/S", path::speedRow(&words.speed_m_s));
  addWorld(&line, &options.studio.world);
  addBounced(&line, &options.studio.bake);
  addLamps(&line, &options.studio.lamps);
  if (!line.read(arguments)) return std::nullopt;
  requireWeather(line, options.place.weather, options.place.surfaces, airOf(options.place));
  requireSense(line, words, options);
  options.output = outputOf(words.places);
  options.studio.render = words.camera.options();
  words.sensor.putInto(&options.studio);
  options.studio.surfaces = {options.place.surfaces};
  render::validate(options.studio.render);
  requireNoDistortion(options.studio.render, "data sets are of");
  options.data_set.camera = options.studio.render.camera;
  if (options.data_set.baseline_m > 0.0)
    options.studio.right =
        image::idealRight(image::calibrationOf(options.data_set.camera), options.data_set.baseline_m, "");
  options.data_set.rate_hz = options.rate_hz / words.path.selection.stride;
  layOut(words, &options);
  options.recipe = recipeOf(line, {{"--cache"}, {"--path", "--calibration"}}, options.studio.world);
  tellOfPlace(line, options.place, options.studio.world);
  return options;
}

}  // namespace sunlit::tools
