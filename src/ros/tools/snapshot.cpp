// One picture of a world under a given sun.
#include <cstdio>
#include <exception>

#include "ros/tools/arguments.h"
#include "ros/tools/lit_world.h"
#include "ros/tools/snapshot_options.h"
#include "sunlit/image/files.h"

namespace sunlit::tools {
namespace {

sky::Daylight daylightOf(const SnapshotOptions& options) {
  if (options.hour) return SkyOfInstant(options.place).at(*options.hour).day;
  return sky::Atmosphere(options.place.air)
      .daylight({Direction(Azimuth(options.sun_azimuth), options.sun_elevation), 1.0});
}

void takeSnapshot(const SnapshotOptions& options) {
  const ViewOptions& view = options.view;
  const light::World world = loadWorld(view.world);
  const sky::Daylight day = daylightOf(options);

  render::Renderer renderer(world, view.render);
  renderer.look(view.map_from_optical);
  image::LinearImage luminance = renderer.light(light::illumination(world, day));
  const double ev100 = image::chooseEv100(luminance, view.exposure);
  if (view.noise.enabled) image::addSensorNoise(ev100, view.noise, {}, &luminance);
  image::writePng(options.output, image::develop(luminance, ev100));
  if (!options.depth_output.empty()) image::writePfm(options.depth_output, renderer.depth());
  std::printf("%s: %zu triangles, EV100 %.2f, %.3g lx on level ground\n", options.output.c_str(),
              world.geometry->scene->triangleCount(), ev100,
              static_cast<double>(day.groundIlluminance().luminance()));
}

}  // namespace
}  // namespace sunlit::tools

int main(int argc, char** argv) {
  using namespace sunlit::tools;
  return runTool("snapshot", argc, argv, parseSnapshotOptions, printSnapshotHelp, takeSnapshot);
}
