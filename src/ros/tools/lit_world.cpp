#include "ros/tools/lit_world.h"

#include <cstdio>
#include <memory>
#include <string>

#include "sunlit/light/transport.h"
#include "sunlit/ros/world_search.h"
#include "sunlit/scene/load.h"

namespace sunlit::tools {

namespace {

/// One line that is written over; silent for a bake of a moment.
class ProgressLine {
 public:
  ~ProgressLine() {
    if (shown_) std::fputc('\n', stderr);
  }
  void show(double share, double seconds_left) {
    const int percent = static_cast<int>(100.0 * share);
    if (percent == percent_ || (!shown_ && seconds_left < 1.0)) return;
    percent_ = percent;
    shown_ = true;
    std::fprintf(stderr, "\rbaking light: %d %%, %.0f s left   ", percent, seconds_left);
  }

 private:
  int percent_ = -1;
  bool shown_ = false;
};

void warn(const std::string& text) {
  std::fprintf(stderr, "warning: %s\n", text.c_str());
}

}  // namespace

light::World loadWorld(const WorldOptions& options) {
  const auto scene = std::make_shared<const scene::Scene>(
      scene::load(options.name, ros_interface::worldSearchPath(options.model_folders)));
  for (const std::string& warning : scene->warnings) warn(warning);
  light::World world(scene);
  if (!options.bounced) return world;
  ProgressLine line;
  const auto progress = [&line](double share, double seconds_left) { line.show(share, seconds_left); };
  const std::string folder = options.cache.empty() ? light::Transport::usualFolder() : options.cache;
  world.transport = light::Transport::cached(world.geometry, {}, folder, progress, warn);
  return world;
}

}  // namespace sunlit::tools
