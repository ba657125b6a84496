// A world as binary glTF, for other programs.
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "ros/tools/arguments.h"
#include "ros/tools/world_arguments.h"
#include "sunlit/ros/world_search.h"
#include "sunlit/scene/export.h"
#include "sunlit/scene/load.h"

namespace sunlit::tools {
namespace {

constexpr const char* kOwnHelp =
    R"(export_world: a world as binary glTF, for other programs. Needs no ROS master.

usage: export_world --out FILE.glb [options]

  --out FILE.glb                 geometry, materials and textures
)";

struct ExportOptions {
  WorldOptions world;
  std::string output;
};

void printHelp() {
  std::fputs(kOwnHelp, stdout);
  std::fputs(kWorldHelp, stdout);
}

std::optional<ExportOptions> parse(const std::vector<std::string>& arguments) {
  ExportOptions options;
  const bool go = readArguments(arguments, [&](const std::string& key, const std::string& value) {
    if (key != "--out") return takeWorld(key, value, &options.world);
    requireFile(key, value, ".glb");
    options.output = value;
    return true;
  });
  if (!go) return std::nullopt;
  if (options.output.empty())
    throw std::invalid_argument("--out FILE.glb is missing; --help lists all options");
  return options;
}

void exportWorld(const ExportOptions& options) {
  const scene::Scene world =
      scene::load(options.world.name, ros_interface::worldSearchPath(options.world.model_folders));
  for (const std::string& warning : world.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  scene::writeGltf(world, options.output);
  std::printf("%s: %zu triangles, %zu materials, %zu textures\n", options.output.c_str(),
              world.triangleCount(), world.materials.size(), world.textures.size());
}

}  // namespace
}  // namespace sunlit::tools

int main(int argc, char** argv) {
  using namespace sunlit::tools;
  return runTool("export_world", argc, argv, parse, printHelp, exportWorld);
}
