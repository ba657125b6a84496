#include "tools/atlas_options.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "sunlit/evaluate/differences/comparer.h"
#include "sunlit/evaluate/localise/localisation.h"
#include "sunlit/quantity/columns.h"
#include "tools/camera_arguments.h"
#include "tools/detector_arguments.h"
#include "tools/path_arguments.h"
#include "tools/recipe.h"
#include "tools/sensor_arguments.h"
#include "tools/world_arguments.h"

namespace sunlit::tools {

namespace {

constexpr double kHoursPerDay = 24.0;
constexpr std::size_t kMostConditions = 5000;

/// What is typed before it is known what it is for.
struct Words {
  CameraWords camera;
  SensorWords sensor;
  PathWords path;
  double query_offset_m = 0.0;
  std::vector<std::string> dates;
  std::vector<TimeOfDay> hours;
  double from_hour = 0.0;
  double to_hour = kHoursPerDay;
  double step_minutes = 30.0;
  AtlasStage stage = AtlasStage::kObserve;
  bool slurm = false;
  SlurmOptions slurm_options;
};

/// "30min", "2h", "90s", or minutes.
double minutesOf(const std::string& option, const std::string& text) {
  const std::vector<std::pair<std::string, double>> units = {{"min", 1.0}, {"h", 60.0}, {"s", 1.0 / 60.0}};
  std::string number = text;
  double minutes_each = 1.0;
  for (const auto& [unit, minutes] : units) {
    if (text.size() <= unit.size() || text.substr(text.size() - unit.size()) != unit) continue;
    number = text.substr(0, text.size() - unit.size());
    minutes_each = minutes;
    break;
  }
  double value = 0.0;
  Field{"step", &value, "", Range::above(0), ""}.setText(number, option);
  require(option, value * minutes_each, {1.0 / 60.0, 60.0 * kHoursPerDay}, "min");
  return value * minutes_each;
}

/// "3/16".
AtlasShard shardOf(const std::string& option, const std::string& text) {
  const std::size_t slash = text.find('/');
  constexpr double kMost = 1e6;
  AtlasShard shard;
  if (slash == std::string::npos) refuse(option, '"' + text + '"', "I/N, such as 3/16");
  Field{"of", &shard.of, "", {1, kMost}, ""}.setText(text.substr(slash + 1), option + "'s N");
  Field{"number", &shard.number, "", {1, static_cast<double>(shard.of)}, ""}.setText(text.substr(0, slash),
                                                                                     option + "'s I");
  return shard;
}

void addTimes(studio::CommandLine* line, Words* words) {
  line->group("Lights");
  line->add("--from HOUR",
            {"from", &words->from_hour, "h", Range::below(0, kHoursPerDay), "first of the day"});
  line->add("--to HOUR",
            {"to", &words->to_hour, "h", Range::above(0, kHoursPerDay), "end, itself not taken"});
  line->add("--step TIME",
            {"step", OwnForm{"30min"}, "", {}, "from one to the next: 30min, 2h, 90s, or minutes"})
      .then([words](const std::string& option, const std::string& text) {
        words->step_minutes = minutesOf(option, text);
      });
  line->add("--hours HOUR[,HOUR...]",
            {"hours", OwnForm{}, "h", Range::below(0, kHoursPerDay), "these hours of the day instead"})
      .then([words](const std::string& option, const std::string& text) {
        words->hours = timesOf(option, text);
      })
      .withoutDefault();
  line->add("--dates DATE[,DATE...]",
            {"dates", OwnForm{}, "", {}, "several days, each with all these times, instead of --date"})
      .then([words](const std::string& option, const std::string& text) {
        words->dates = splitAtCommas(text);
        for (const std::string& date : words->dates) dateOf(option, date, 0.0);
      })
      .withoutDefault();
}

void addMethods(studio::CommandLine* line, evaluate::AtlasOptions* atlas, Words* words) {
  line->group("Methods, and how they localise");
  addMatching(line, &atlas->verify);
  line->add("--query-offset M",
            {"query_offset",
             &words->query_offset_m,
             "m",
             {-1000, 1000},
             "queries are of a second drive, so far to the left of that of the maps; pictures "
             "of both are made, and D and matches are still of equal poses"});
  line->add("--map-every M", evaluate::mapEveryRow(&atlas->map_every_m));
  for (const Field& row : evaluate::fieldsOf(atlas->localiser)) {
    const bool is_of_matching = row.key == "ratio" || row.key == "inclusive";
    const std::string option = (is_of_matching ? "--localise-" : "--") + optionOf(row.key).substr(2);
    line->add(option + " VALUE", row);
  }
}

void addWork(studio::CommandLine* line, AtlasRunOptions* options, Words* words) {
  line->group("Parts of the work, and clusters");
  line->add(
      "--estimate",
      {"estimate", &options->estimate, "", {}, "says what the atlas will take of disk and time, and ends"});
  line->add("--stage", {"stage",
                        choiceOf(&words->stage, {"observe", "compare"}),
                        "",
                        {},
                        "only this: observe renders and finds features, compare makes maps of them and looks "
                        "for queries"})
      .withoutDefault();
  line->add("--shard I/N", {"shard", OwnForm{}, "", {}, "of the stage only the I-th of N shares, I from 1"})
      .then([options](const std::string& option, const std::string& text) {
        options->shard = shardOf(option, text);
      })
      .withoutDefault();
  line->add("--merge", {"merge", &options->merge, "", {}, "only puts together what all stages left"});
  line->add(
      "--unit-poses N",
      {"unit_poses",
       &options->unit_poses,
       "",
       {0, 1e6},
       "poses of one unit of observing; 0: 16, and more where the path would have more than 500 units"});
  line->add("--unit-conditions N", {"unit_conditions",
                                    &options->unit_conditions,
                                    "",
                                    {0, 1e6},
                                    "lights of one unit of observing; 0: all, since a pose is drawn once for "
                                    "those of a unit"});
  line->add("--slurm", {"slurm",
                        &words->slurm,
                        "",
                        {},
                        "writes job scripts into FOLDER/slurm and hands them to sbatch: an array for each "
                        "stage, and the merge, one after another"});
  line->add("--slurm-tasks N",
            {"slurm_tasks", &words->slurm_options.tasks, "", {1, 1e5}, "of each array at most"});
  line->add("--slurm-option TEXT", {"slurm_option",
                                    &words->slurm_options.options,
                                    "",
                                    {},
                                    "of sbatch, such as --slurm-option=--time=4:00:00; may be repeated"});
  line->add("--submit true|false",
            {"submit", &words->slurm_options.submits, "", {}, "false: the scripts are only written"});
  line->add("--pictures true|false",
            {"pictures", &options->draws, "", {}, "heat maps and a page are drawn by the report in the end"});
}

/// Options that do not change what is found.
const std::set<std::string>& ofNoResult() {
  static const std::set<std::string> options = {"--out",          "--cache",  "--estimate", "--stage",
                                                "--shard",        "--merge",  "--slurm",    "--slurm-tasks",
                                                "--slurm-option", "--submit", "--pictures"};
  return options;
}

std::vector<TimeOfDay> timesOf(const Words& words) {
  if (!words.hours.empty()) return words.hours;
  std::vector<TimeOfDay> times;
  const double hours = words.to_hour - words.from_hour;
  if (!(hours > 0.0)) throw std::invalid_argument("--to must be later than --from");
  // A last one that rounding would put just before the end is at the end.
  const double count = std::ceil(hours * 60.0 / words.step_minutes - 1e-9);
  if (count > static_cast<double>(kMostConditions))
    throw std::invalid_argument("--step would make more than " + std::to_string(kMostConditions) + " times");
  for (int i = 0; i < static_cast<int>(count); ++i) {
    times.push_back(TimeOfDay::at(words.from_hour * 3600.0 + i * words.step_minutes * 60.0));
  }
  return times;
}

std::vector<AtlasCondition> conditionsOf(const Words& words, const astronomy::CivilDate& usual) {
  std::vector<astronomy::CivilDate> dates;
  for (const std::string& text : words.dates) dates.push_back(dateOf("--dates", text, usual.timezone));
  if (dates.empty()) dates.push_back(usual);
  std::vector<AtlasCondition> conditions;
  std::set<std::string> names;
  for (const astronomy::CivilDate& date : dates) {
    for (const TimeOfDay& time : timesOf(words)) {
      const std::string of_day = dates.size() > 1 ? textOfDate(date) + "_" : "";
      conditions.push_back({date, time, of_day + time.name()});
      if (!names.insert(conditions.back().name).second)
        throw std::invalid_argument("the light " + conditions.back().name + " is asked for twice");
    }
  }
  if (conditions.size() > kMostConditions)
    throw std::invalid_argument("--dates and times make more than " + std::to_string(kMostConditions) +
                                " lights");
  return conditions;
}

std::vector<AtlasPose> posesOf(const Words& words, const studio::WorldOptions& world) {
  const path::Waypoints waypoints = waypointsOf(words.path, world);
  const std::vector<Eigen::Isometry3d> all = posesAlong(waypoints, words.path);
  PathWords beside = words.path;
  beside.sampling.offset_m += words.query_offset_m;
  const std::vector<Eigen::Isometry3d> all_beside = posesAlong(waypoints, beside);
  std::vector<AtlasPose> poses;
  const int end = words.path.selection.end(static_cast<int>(all.size()));
  for (int i = words.path.selection.first; i < end; i += words.path.selection.stride)
    poses.push_back({i, all[static_cast<std::size_t>(i)], all_beside[static_cast<std::size_t>(i)]});
  return poses;
}

/// Throws for words that do not go together.
void requireSense(const studio::CommandLine& line, const Words& words, const AtlasRunOptions& options) {
  for (const std::string other : {"--from", "--to", "--step"}) {
    if (line.has("--hours") && line.has(other))
      throw std::invalid_argument("--hours and " + other + " are both given; one of them");
  }
  if (line.has("--dates") && line.has("--date"))
    throw std::invalid_argument("--dates and --date are both given; one of them");
  line.requireWith("--shard", {"--stage"});
  for (const std::string option : {"--slurm-tasks", "--slurm-option", "--submit"})
    line.requireWith(option, {"--slurm"});
  const int parts = (line.has("--stage") ? 1 : 0) + (options.merge ? 1 : 0) + (words.slurm ? 1 : 0) +
                    (options.estimate ? 1 : 0);
  if (parts > 1)
    throw std::invalid_argument("of --stage, --merge, --slurm and --estimate only one goes at a time");
  words.sensor.requireSense(line);
  words.camera.requireSense(options.studio.bake);
}

/// In their order, as one word each.
std::vector<std::string> againOf(const studio::CommandLine& line) {
  static const std::set<std::string> of_the_part = {"--out",         "--estimate",     "--stage",
                                                    "--shard",       "--merge",        "--slurm",
                                                    "--slurm-tasks", "--slurm-option", "--submit"};
  std::vector<std::string> again;
  for (const auto& [option, value] : line.given()) {
    if (of_the_part.count(option) == 0) again.push_back(option + '=' + value);
  }
  return again;
}

void addShared(studio::CommandLine* line, AtlasRunOptions* options, Words* words) {
  addPath(line, &words->path);
  addPlace(line, &options->place);
  addCamera(line, &words->camera);
  addSensor(line, &words->sensor);
  addWorld(line, &options->studio.world);
  addBounced(line, &options->studio.bake);
  addLamps(line, &options->studio.lamps);
  addDetectors(line, &options->atlas.verify);
}

constexpr const char* kAbout =
    "atlas: a path at every time of a day, or of several: how well queries of each light are found in a map "
    "of "
    "each other, by each method. Without --query-offset map and queries are of one drive, so a query whose "
    "pose is that of a key frame, one in map-every / spacing, is looked for where its own place is in the "
    "map. Needs no ROS master.";

}  // namespace

std::optional<AtlasRunOptions> parseAtlasOptions(const std::vector<std::string>& arguments) {
  AtlasRunOptions options;
  options.atlas.verify.detectors = evaluate::usualDetectors(evaluate::ComparerOptions());
  Words words;
  studio::CommandLine line(kAbout, "atlas --out FOLDER [options]");
  line.group("Output");
  line.add(
      "--out FOLDER",
      {"out",
       &options.output,
       "",
       {},
       "gets atlas.csv, conditions.csv and heat maps; a broken off run goes on there with the same options"});
  addTimes(&line, &words);
  addMethods(&line, &options.atlas, &words);
  addWork(&line, &options, &words);
  addShared(&line, &options, &words);
  if (!line.read(arguments)) return std::nullopt;
  requireWeather(line, options.place.weather, options.place.surfaces, airOf(options.place));
  if (!line.has("--out")) throw std::invalid_argument("--out FOLDER is missing; --help lists all options");
  requireSense(line, words, options);
  options.studio.render = words.camera.options();
  words.sensor.putInto(&options.studio);
  options.studio.surfaces = {options.place.surfaces};
  render::validate(options.studio.render);
  requireNoDistortion(options.studio.render, "queries are localised with");
  options.conditions = conditionsOf(words, options.place.date);
  options.poses = posesOf(words, options.studio.world);
  options.atlas.has_query_drive = words.query_offset_m != 0.0;
  if (line.has("--stage")) options.stage = words.stage;
  if (words.slurm) options.slurm = words.slurm_options;
  options.recipe =
      recipeOf(line, {ofNoResult(), {"--path", "--calibration", "--onnx-model"}}, options.studio.world);
  options.again = againOf(line);
  tellOfPlace(line, options.place, options.studio.world);
  return options;
}

}  // namespace sunlit::tools
