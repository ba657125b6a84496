/// What smooth surfaces of a picture mirror: the surroundings themselves, met by rays.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"
#include "sunlit/scene/scene.h"

namespace sunlit::light {

struct Reflections {
  /// One of a tile's surfaces.
  struct Mirroring {
    std::uint32_t surface = 0;  ///< index into Tile::surfaces
    float by_rays = 0.0f;       ///< share of its mirrored light that rays tell, 0 … 1
    std::uint32_t rays = 0;
    float weight = 0.0f;  ///< of its rays together, by LobeRay::weight, which all shares are parts of
    std::uint32_t first = 0, count = 0;  ///< what they met, in `seen`; Surface::share is of all of them
    std::uint32_t first_open = 0, open_count = 0;  ///< those that met nothing, in TileReflections::open
    float nearest_m = std::numeric_limits<float>::infinity();  ///< that they met
    /// Of what shines, as far as it was looked for, beside what they met: luminance, cd/m², times the weight
    /// of each point; over `weight` it is that which the surface shows.
    Eigen::Array3f shining = Eigen::Array3f::Zero();
  };
  /// Rays that met nothing.
  struct Open {
    Eigen::Vector3f towards;  ///< unit
    Eigen::Array3f share;     ///< of all of their surface's, coloured by glass
  };
  struct TileReflections {
    std::vector<Mirroring> surfaces;  ///< in their order
    std::vector<Open> open;
  };
  /// One a tile, or none at all where nothing mirrors by rays.
  std::vector<TileReflections> tiles;
};

/// Who looks at what mirrors: the camera, or other mirrors, whose rays go on as Surface::to_eye tells.
enum class Onlooker { kCamera, kMirrors };

/// What there is to be mirrored.
struct MirroredWorld {
  const scene::Scene& scene;
  const Visibility& visibility;  ///< of `scene`; may know bodies
};

/// What smooth ones of `surfaces` mirror, by a ray from each of their samples. What these rays met goes to
/// `seen`, which is empty before, each in the pixel of the surface that mirrors it, as seen from there.
/// Parallel; next to nothing where nothing is smooth.
Reflections reflect(const Surfaces& surfaces, Onlooker onlooker, const MirroredWorld& world, Surfaces* seen);

}  // namespace sunlit::light
