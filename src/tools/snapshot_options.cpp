#include "tools/snapshot_options.h"

#include <stdexcept>

namespace sunlit::tools {

namespace {

void addOwn(studio::CommandLine* line, SnapshotOptions* options, CivilDateTime* clock) {
  line->group("Picture");
  line->add("--out FILE.png", {"out", &options->output, "", {}, "the picture"})
      .then([](const std::string& option, const std::string& file) {
        studio::requireFile(option, file, ".png");
      });
  line->add("--depth FILE.pfm", {"depth",
                                 &options->depth_output,
                                 "",
                                 {},
                                 "depth too: portable float map, m along the optical axis (equidistant and "
                                 "omni: from the camera), NaN "
                                 "where there is none"})
      .then([](const std::string& option, const std::string& file) {
        studio::requireFile(option, file, ".pfm");
      });
  line->add("--sun AZIMUTH,ELEVATION", "a sun without moon and stars", fieldsOf(options->sun));
  const std::vector<Field> rows = fieldsOf(*clock);
  line->add("--time HH:MM[:SS]", "instead of --sun: sun, moon and stars of a time of the day below",
            {fieldOf(rows, "hour"), fieldOf(rows, "minute"), fieldOf(rows, "second")})
      .withoutDefault();
}

}  // namespace

std::optional<SnapshotOptions> parseSnapshotOptions(const std::vector<std::string>& arguments) {
  SnapshotOptions options;
  CivilDateTime clock;
  studio::CommandLine line(
      "snapshot: one picture of a world under a given sun, or the sky of a given date, time and place. Needs "
      "no ROS master.",
      "snapshot --out FILE.png [options]");
  addOwn(&line, &options, &clock);
  addPlace(&line, &options.place);
  const ViewArguments view(&line);
  if (!line.read(arguments)) return std::nullopt;
  requireWeather(line, options.place.weather, options.place.surfaces, airOf(options.place));
  if (!line.has("--out")) throw std::invalid_argument("--out FILE is missing; --help lists all options");
  if (line.has("--sun") && line.has("--time"))
    throw std::invalid_argument("--sun and --time are both given; one of them");
  for (const char* option : {"--site", "--date", "--timezone"}) line.requireWith(option, {"--time"});
  if (line.has("--time")) options.hour = clock.hour + clock.minute / 60.0 + clock.second / 3600.0;
  options.view = view.options(options.place.weather);
  options.view.studio.surfaces = {options.place.surfaces};
  if (line.has("--time")) tellOfPlace(line, options.place, options.view.studio.world);
  return options;
}

}  // namespace sunlit::tools
