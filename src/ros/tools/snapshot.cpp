// One picture of a world under a given sun.
#include <cstdio>
#include <exception>
#include <memory>

#include "ros/tools/snapshot_options.h"
#include "sunlit/image/files.h"
#include "sunlit/ros/world_search.h"
#include "sunlit/scene/load.h"
#include "sunlit/sky/atmosphere.h"

namespace sunlit::tools {
namespace {

void takeSnapshot(const SnapshotOptions& options) {
  const auto scene = std::make_shared<const scene::Scene>(
      scene::load(options.world, ros_interface::worldSearchPath(options.model_folders)));
  for (const std::string& warning : scene->warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  const sky::Atmosphere atmosphere{sky::AtmosphereOptions()};
  const sky::Daylight day =
      atmosphere.daylight({Direction(Azimuth(options.sun_azimuth), options.sun_elevation), 1.0});

  render::Renderer renderer(scene, options.render);
  renderer.look(options.map_from_optical);
  const image::LinearImage luminance = renderer.light(day);
  const double ev100 = image::chooseEv100(luminance, options.exposure);
  image::writePng(options.output, image::develop(luminance, ev100));
  if (!options.depth_output.empty()) image::writePfm(options.depth_output, renderer.depth());
  std::printf("%s: %zu triangles, EV100 %.2f, %.0f lx on level ground\n", options.output.c_str(),
              scene->triangleCount(), ev100, static_cast<double>(day.groundIlluminance().luminance()));
}

}  // namespace
}  // namespace sunlit::tools

int main(int argc, char** argv) {
  try {
    const auto options = sunlit::tools::parseSnapshotOptions({argv + 1, argv + argc});
    if (!options) {
      std::fputs(sunlit::tools::kSnapshotHelp, stdout);
      return 0;
    }
    sunlit::tools::takeSnapshot(*options);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "snapshot: %s\n", error.what());
    return 1;
  }
}
