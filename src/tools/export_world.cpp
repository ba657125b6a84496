// A world as binary glTF, for other programs.
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sunlit/light/lamps.h"
#include "sunlit/scene/export.h"
#include "sunlit/studio/command_line.h"
#include "sunlit/studio/world.h"
#include "tools/terminal.h"
#include "tools/world_arguments.h"

namespace sunlit::tools {
namespace {

struct ExportOptions {
  studio::WorldOptions world;
  light::LampOptions lamps;
  std::string output;
};

std::optional<ExportOptions> parse(const std::vector<std::string>& arguments) {
  ExportOptions options;
  studio::CommandLine line("export_world: a world as binary glTF, for other programs. Needs no ROS master.",
                           "export_world --out FILE.glb [options]");
  line.group("Output");
  line.add("--out FILE.glb", {"out", &options.output, "", {}, "geometry, materials, textures and lamps"})
      .then([](const std::string& option, const std::string& file) {
        studio::requireFile(option, file, ".glb");
      });
  addWorld(&line, &options.world);
  line.add("--lamps-colour LX", fieldOf(fieldsOf(options.lamps), "lamps_colour"));
  if (!line.read(arguments)) return std::nullopt;
  if (!line.has("--out")) throw std::invalid_argument("--out FILE.glb is missing; --help lists all options");
  return options;
}

void exportWorld(const ExportOptions& options) {
  const studio::Reports reports = onTerminal();
  scene::Scene world = studio::loadScene(options.world, reports);
  world.lamps = light::burning(world.lamps, options.lamps);  // in cd
  for (const std::string& lost : scene::writeGltf(world, options.output)) reports.warning(lost);
  std::printf("%s: %zu triangles, %zu materials, %zu textures, %zu lamps\n", options.output.c_str(),
              world.triangleCount(), world.materials.size(), world.textures.size(), world.lamps.size());
}

}  // namespace
}  // namespace sunlit::tools

int main(int argc, char** argv) {
  using namespace sunlit::tools;
  return sunlit::studio::runProgram({"export_world", argc, argv}, parse, exportWorld);
}
