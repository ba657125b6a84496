/// A world from a name or a file to what light can travel through.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sunlit/light/lamps.h"
#include "sunlit/light/transport.h"
#include "sunlit/light/world.h"
#include "sunlit/quantity/field.h"
#include "sunlit/scene/load.h"
#include "sunlit/scene/robot.h"
#include "sunlit/scene/scene.h"
#include "sunlit/studio/reports.h"

namespace sunlit::studio {

struct WorldOptions {
  std::string name = scene::kRaceTrack;  ///< as scene::load() takes it
  std::vector<std::string> model_path;   ///< folders searched before those of SearchPath::withEnvironment()
  scene::Missing missing = scene::Missing::kStop;

  /// Where all of the world is looked for, and a robot in it.
  scene::SearchPath searchPath() const;
};

inline std::vector<Field> fieldsOf(WorldOptions& world) {
  return {{"world",
           &world.name,
           "",
           {},
           "race_track (built in), or a file: .world .sdf .urdf .dae .gltf .glb .obj"},
          {"model_path",
           &world.model_path,
           "",
           {},
           "folders searched for model:// and relative addresses, after that of the file that names them"},
          {"missing",
           choiceOf(&world.missing, {"stop", "warn"}),
           "",
           {},
           "for a model or mesh that is not there or cannot be read; warn: the rest is drawn"}};
}

/// Sky light and bounced light, baked once per world.
struct BakeOptions {
  bool enabled = true;
  light::TransportOptions transport;
  std::string cache_dir;  ///< empty: as image::usualCacheFolder()
  double cache_limit_gb = 6.0;
};

inline std::vector<Field> fieldsOf(BakeOptions& bake) {
  return joined(
      {{{"enabled", &bake.enabled, "", {}, "false: every surface sees the open sky, and passes no light on"}},
       fieldsOf(bake.transport),
       {{"cache_dir",
         &bake.cache_dir,
         "",
         {},
         "empty: SUNLIT_CACHE_DIR, or sunlit in XDG_CACHE_HOME, or ~/.cache/sunlit"},
        {"cache_limit",
         &bake.cache_limit_gb,
         "GB",
         {0, 1e6},
         "of the bakes there; beyond it those unused for longest go"}}});
}

/// Where the bakes of these options are kept.
light::BakeCache cacheOf(const BakeOptions& options);

/// As scene::requireWorld().
std::string requireWorld(const WorldOptions& options);

/// What scene::load() gives; its warnings become those of `reports`. Throws as it does.
scene::Scene loadScene(const WorldOptions& options, const Reports& reports);

/// That, flattened; with the `robot`, if there is one, as what moves in it. Bakes nothing. The built-in world
/// is kept in `cache_folder`. Throws what scene::load() throws.
light::World loadWorld(const WorldOptions& options, const std::string& cache_folder,
                       const std::optional<scene::Robot>& robot, const Reports& reports);

/// "9 triangles in 90 x 60 x 2.5 m", of all that stands still: one in millimetres is seen to be.
std::string sizeOf(const light::World& world);

/// Around all that stands still, m in `map`; empty where nothing does.
Eigen::AlignedBox3d boundsOf(const light::World& world);

/// Of those bounds, for who sees nothing of the world: "which reaches from -1,-2,0 to 3,4,5 m".
std::string reachOf(const Eigen::AlignedBox3d& bounds);

/// Whether `place` is farther from those bounds than a camera sees, `far_m`, or than ten times their size,
/// from where they are no more than 6° wide; never of what is empty.
bool isFarFrom(const Eigen::AlignedBox3d& bounds, const Eigen::Vector3d& place, double far_m);

/// Throws std::invalid_argument, naming the groups that there are, for one that is to stay dark and that no
/// lamp of `world` belongs to. Warns where there are more groups than the bake tells apart.
void requireGroups(const light::World& world, const light::LampOptions& lamps, const Reports& reports);

/// Bakes how light spreads in `world`, or reads it from the cache; null where the options want none. Throws
/// as light::Transport::bake().
std::shared_ptr<const light::Transport> bake(const light::World& world, const BakeOptions& options,
                                             const Reports& reports);

}  // namespace sunlit::studio
