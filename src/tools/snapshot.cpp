// One picture of a world under a given sun.
#include <cstdio>
#include <exception>
#include <string>

#include "sunlit/image/files.h"
#include "sunlit/studio/command_line.h"
#include "sunlit/studio/sky.h"
#include "sunlit/studio/studio.h"
#include "tools/blind_poses.h"
#include "tools/snapshot_options.h"
#include "tools/terminal.h"

namespace sunlit::tools {
namespace {

sky::Daylight daylightOf(const SnapshotOptions& options, const studio::Studio& studio) {
  studio::Sky sky = skyOver(studio, options.place, options.hour.has_value());
  if (options.hour)
    return sky.daylight(bodiesOf(options.place, *options.hour), weatherAt(options.place, *options.hour));
  return sky.daylight({{Direction(Azimuth(options.sun.azimuth), options.sun.elevation), 1.0}},
                      options.place.weather);
}

void takeSnapshot(const SnapshotOptions& options) {
  const ViewOptions& view = options.view;
  studio::Studio studio(view.studio, std::nullopt, onTerminal());
  const sky::Daylight day = daylightOf(options, studio);
  studio.look(view.placeIn(studio), {}, view.motion);
  const studio::Developed developed = studio.photograph(studio.illumination(day), {});
  image::writePng(options.output, developed.picture);
  if (!options.depth_output.empty()) image::writePfm(options.depth_output, studio.depth());
  if (!warnIfBlind(studio) && image::isBlack(developed.picture))
    std::fprintf(stderr, "warning: the picture is black all over: %s\n", image::kWhyBlack);
  const std::string eclipse =
      options.hour ? textOfEclipse(bodiesOf(options.place, *options.hour)) : std::string();
  std::printf("%s: %s, EV100 %.2f, %.3g lx on level ground%s\n", options.output.c_str(),
              studio::sizeOf(studio.world()).c_str(), developed.ev100,
              static_cast<double>(day.groundIlluminance().luminance()), eclipse.c_str());
}

}  // namespace
}  // namespace sunlit::tools

int main(int argc, char** argv) {
  using namespace sunlit::tools;
  return sunlit::studio::runProgram({"snapshot", argc, argv}, parseSnapshotOptions, takeSnapshot);
}
