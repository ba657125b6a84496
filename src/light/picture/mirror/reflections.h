/// What smooth surfaces of a picture mirror: the surroundings themselves, met by rays.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"
#include "sunlit/scene/scene.h"

namespace sunlit::light {

struct Reflections {
  /// One of a tile's surfaces.
  struct Mirroring {
    std::uint32_t surface;  ///< index into Tile::surfaces
    float by_rays;          ///< share of its mirrored light that rays tell, 0 … 1
    /// Those that its rays met, in their tile: parts of all of its rays by Surface::samples, each
    /// coloured by Surface::share.
    std::uint32_t first = 0, count = 0;
    std::uint32_t rays = 0;
    Eigen::Array3f sky = Eigen::Array3f::Zero();  ///< share of the rays that met nothing, coloured by glass
    Eigen::Vector3f towards = Eigen::Vector3f::UnitZ();  ///< where these look, unit
  };
  /// In the order of their surfaces; one list a tile, or none at all where nothing mirrors by rays.
  std::vector<std::vector<Mirroring>> tiles;
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
