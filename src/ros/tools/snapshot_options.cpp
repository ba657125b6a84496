#include "ros/tools/snapshot_options.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "ros/tools/arguments.h"

namespace sunlit::tools {

namespace {

constexpr const char* kOwnHelp =
    R"(snapshot: one picture of a world under a given sun, or the sky of a given date, time and place. Needs no ROS master.

usage: snapshot --out FILE.png [options]

  --out FILE.png                 the picture
  --depth FILE.pfm               depth too: portable float map, m along the optical axis, NaN where there is none
  --sun AZIMUTH,ELEVATION        deg; azimuth clockwise from north (default 180,40); without moon and stars
  --time HH:MM[:SS]              instead of --sun: sun, moon and stars of this time of the day below
)";

/// "4:30" or "04:30:15" as hours.
double hourOf(const std::string& text) {
  const char* wanted = "a time of the day, such as 04:30 or 04:30:15";
  const std::vector<double> parts = numbers("--time", text, {2, 3}, ':');
  const double second = parts.size() == 3 ? parts[2] : 0.0;
  const bool whole = parts[0] == std::floor(parts[0]) && parts[1] == std::floor(parts[1]);
  if (!whole || parts[0] < 0 || parts[0] > 23 || parts[1] < 0 || parts[1] > 59 || second < 0 || second >= 60)
    reject("--time", text, wanted);
  return parts[0] + parts[1] / 60.0 + second / 3600.0;
}

bool takeOwn(const std::string& key, const std::string& value, SnapshotOptions* options) {
  if (key == "--sun") {
    const std::vector<double> sun = numbers(key, value, {2, 2});
    if (std::abs(sun[1]) > 90.0) reject(key, value, "azimuth, and an elevation of -90 ... 90 degrees");
    options->sun_azimuth = Angle::degrees(sun[0]);
    options->sun_elevation = Angle::degrees(sun[1]);
  } else if (key == "--time") {
    options->hour = hourOf(value);
  } else if (key == "--depth") {
    requireFile(key, value, ".pfm");
    options->depth_output = value;
  } else if (key == "--out") {
    requireFile(key, value, ".png");
    options->output = value;
  } else {
    return false;
  }
  return true;
}

}  // namespace

void printSnapshotHelp() {
  std::fputs(kOwnHelp, stdout);
  std::fputs(kPlaceHelp, stdout);
  std::fputs(viewHelp().c_str(), stdout);
}

std::optional<SnapshotOptions> parseSnapshotOptions(const std::vector<std::string>& arguments) {
  SnapshotOptions options;
  ViewArguments view;
  PlaceArguments place;
  bool has_sun = false;
  std::string of_time;  // an option that only a time gives sense to
  const bool go = readArguments(arguments, [&](const std::string& key, const std::string& value) {
    has_sun = has_sun || key == "--sun";
    if (view.take(key, value) || takeOwn(key, value, &options)) return true;
    if (!place.take(key, value)) return false;
    if (key != "--turbidity" && key != "--ozone") of_time = key;
    return true;
  });
  if (!go) return std::nullopt;
  if (options.output.empty()) throw std::invalid_argument("--out FILE is missing; --help lists all options");
  if (has_sun && options.hour) throw std::invalid_argument("--sun and --time are both given; one of them");
  if (!of_time.empty() && !options.hour) throw std::invalid_argument(of_time + " needs --time HH:MM too");
  options.view = view.options();
  options.place = place.options();
  return options;
}

}  // namespace sunlit::tools
