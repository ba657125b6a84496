// A world as binary glTF, for other programs.
#include <chrono>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sunlit/image/cache_folder.h"
#include "sunlit/light/lamps.h"
#include "sunlit/path/path.h"
#include "sunlit/render/baked_looks.h"
#include "sunlit/scene/export.h"
#include "sunlit/scene/load.h"
#include "sunlit/studio/command_line.h"
#include "sunlit/studio/world.h"
#include "tools/path_arguments.h"
#include "tools/progress_line.h"
#include "tools/terminal.h"
#include "tools/world_arguments.h"

namespace sunlit::tools {
namespace {

struct ExportOptions {
  studio::WorldOptions world;
  light::LampOptions lamps;
  std::string output;
  bool bakes = false;
  render::BakedLooksOptions looks;
  std::string path;  ///< file; empty: that of the built-in world
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
  line.add("--texel M", fieldOf(fieldsOf(options.looks), "texel")).withoutDefault();
  line.add("--path FILE",
           {"path",
            &options.path,
            "",
            {},
            "with --texel: waypoints, CSV or TUM, beyond 10 m from which texels grow with the distance; "
            "without it the path of race_track, in other worlds none: all texels are as fine"});
  addWorld(&line, &options.world);
  line.add("--lamps-colour LX", fieldOf(fieldsOf(options.lamps), "lamps_colour"));
  if (!line.read(arguments)) return std::nullopt;
  if (!line.has("--out")) throw std::invalid_argument("--out FILE.glb is missing; --help lists all options");
  line.requireWith("--path", {"--texel"});
  options.bakes = line.has("--texel");
  return options;
}

/// Poses at least every 2 m.
std::vector<Eigen::Vector3d> eyesOf(const ExportOptions& options) {
  if (options.path.empty() && options.world.name != scene::kRaceTrack) return {};
  path::PathOptions sampling;
  sampling.spacing_m = 2.0;
  std::vector<Eigen::Vector3d> eyes;
  for (const Eigen::Isometry3d& pose : path::posesAlong(waypointsOf(options.path), sampling))
    eyes.push_back(pose.translation());
  return eyes;
}

scene::Scene withBakedLooks(const scene::Scene& world, const ExportOptions& options,
                            const studio::Reports& reports) {
  using Clock = std::chrono::steady_clock;
  render::BakedLooksOptions looks_options = options.looks;
  looks_options.eyes = eyesOf(options);
  const render::BakedLooks looks(world, looks_options);
  // PNGs of noise.
  constexpr double kBytesATexel = 2.0, kMemoryATexel = 9.0;
  const auto texels = static_cast<double>(looks.texels());
  std::printf("%zu textures of %.4g million texels: about %.2g GB in the file, %.2g GB of memory\n",
              looks.pages(), 1e-6 * texels, 1e-9 * kBytesATexel * texels, 1e-9 * kMemoryATexel * texels);
  std::fflush(stdout);
  for (const std::string& note : looks.notes()) reports.warning(note);
  ProgressLine line;
  const Clock::time_point begin = Clock::now();
  return looks.make([&](double share) {
    const double spent_s = std::chrono::duration<double>(Clock::now() - begin).count();
    line.show("painting textures", share, spent_s * (1.0 / share - 1.0));
  });
}

void exportWorld(const ExportOptions& options) {
  const studio::Reports reports = onTerminal();
  scene::Scene world = studio::loadScene(options.world, reports);
  world.lamps = light::burning(world.lamps, options.lamps);  // in cd
  if (options.bakes) world = withBakedLooks(world, options, reports);
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
