// A world as binary glTF, for other programs.
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sunlit/scene/export.h"
#include "sunlit/studio/command_line.h"
#include "sunlit/studio/world.h"
#include "tools/terminal.h"
#include "tools/world_arguments.h"

namespace sunlit::tools {
namespace {

struct ExportOptions {
  studio::WorldOptions world;
  std::string output;
};

std::optional<ExportOptions> parse(const std::vector<std::string>& arguments) {
  ExportOptions options;
  studio::CommandLine line("export_world: a world as binary glTF, for other programs. Needs no ROS master.",
                           "export_world --out FILE.glb [options]");
  line.group("Output");
  line.add("--out FILE.glb", {"out", &options.output, "", {}, "geometry, materials and textures"})
      .then([](const std::string& option, const std::string& file) {
        studio::requireFile(option, file, ".glb");
      });
  addWorld(&line, &options.world);
  if (!line.read(arguments)) return std::nullopt;
  if (!line.has("--out")) throw std::invalid_argument("--out FILE.glb is missing; --help lists all options");
  return options;
}

void exportWorld(const ExportOptions& options) {
  const scene::Scene world = studio::loadScene(options.world, onTerminal());
  scene::writeGltf(world, options.output);
  std::printf("%s: %zu triangles, %zu materials, %zu textures\n", options.output.c_str(),
              world.triangleCount(), world.materials.size(), world.textures.size());
}

}  // namespace
}  // namespace sunlit::tools

int main(int argc, char** argv) {
  using namespace sunlit::tools;
  return sunlit::studio::runProgram({"export_world", argc, argv}, parse, exportWorld);
}
