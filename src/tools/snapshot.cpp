// One picture of a world under a given sun.
#include <cstdio>
#include <exception>

#include "sunlit/image/files.h"
#include "sunlit/studio/command_line.h"
#include "sunlit/studio/sky.h"
#include "sunlit/studio/studio.h"
#include "tools/snapshot_options.h"
#include "tools/terminal.h"

namespace sunlit::tools {
namespace {

sky::Daylight daylightOf(const SnapshotOptions& options, const light::World& world) {
  studio::Sky sky = skyOver(world, options.place, options.hour.has_value());
  if (options.hour) return sky.daylight(bodiesOf(options.place, *options.hour));
  return sky.daylight({{Direction(Azimuth(options.sun.azimuth), options.sun.elevation), 1.0}});
}

void takeSnapshot(const SnapshotOptions& options) {
  const ViewOptions& view = options.view;
  studio::Studio studio(view.studio, std::nullopt, onTerminal());
  const sky::Daylight day = daylightOf(options, studio.world());
  studio.look(view.map_from_camera);
  const studio::Developed developed = studio.photograph(studio.illumination(day), {});
  image::writePng(options.output, developed.picture);
  if (!options.depth_output.empty()) image::writePfm(options.depth_output, studio.depth());
  std::printf("%s: %zu triangles, EV100 %.2f, %.3g lx on level ground\n", options.output.c_str(),
              studio.world().geometry->scene->triangleCount(), developed.ev100,
              static_cast<double>(day.groundIlluminance().luminance()));
}

}  // namespace
}  // namespace sunlit::tools

int main(int argc, char** argv) {
  using namespace sunlit::tools;
  return sunlit::studio::runProgram({"snapshot", argc, argv}, parseSnapshotOptions, takeSnapshot);
}
