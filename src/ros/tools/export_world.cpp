// A world as binary glTF, for other programs.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "ros/tools/arguments.h"
#include "sunlit/ros/world_search.h"
#include "sunlit/scene/export.h"
#include "sunlit/scene/load.h"

namespace sunlit::tools {
namespace {

constexpr const char* kUsage =
    "usage: export_world --world WORLD --out FILE.glb [--model-path FOLDER:FOLDER...]\n"
    "  WORLD  race_track, or a file: .world .sdf .dae .gltf .glb .obj\n";

struct ExportOptions {
  std::string world = scene::kRaceTrack;
  std::string output;
  std::vector<std::string> model_folders;
};

std::vector<std::string> splitAtColons(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(':', begin), text.size());
    if (end > begin) parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

ExportOptions parse(int argc, char** argv) {
  ExportOptions options;
  for (int i = 1; i < argc; i += 2) {
    const std::string key = argv[i];
    if (i + 1 >= argc) throw std::invalid_argument(key + " needs a value");
    const std::string value = argv[i + 1];
    if (key == "--world") {
      options.world = value;
    } else if (key == "--out") {
      requireEnding(key, value, ".glb");
      options.output = value;
    } else if (key == "--model-path") {
      options.model_folders = splitAtColons(value);
    } else {
      throw std::invalid_argument("there is no option " + key + "; --help lists all");
    }
  }
  if (options.output.empty())
    throw std::invalid_argument("--out names the file to write, and is missing; --help lists all options");
  return options;
}

void exportWorld(const ExportOptions& options) {
  const scene::Scene world =
      scene::load(options.world, ros_interface::worldSearchPath(options.model_folders));
  for (const std::string& warning : world.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  scene::writeGltf(world, options.output);
  std::printf("%s: %zu triangles, %zu materials, %zu textures\n", options.output.c_str(),
              world.triangleCount(), world.materials.size(), world.textures.size());
}

}  // namespace
}  // namespace sunlit::tools

int main(int argc, char** argv) {
  if (argc == 2 && (std::string(argv[1]) == "--help" || std::string(argv[1]) == "-h")) {
    std::fputs(sunlit::tools::kUsage, stdout);
    return 0;
  }
  try {
    sunlit::tools::exportWorld(sunlit::tools::parse(argc, argv));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "export_world: %s\n", error.what());
  }
  return 1;
}
