/// Everything that the cameras of one scene share.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sunlit/light/bodies.h"
#include "sunlit/light/geometry.h"
#include "sunlit/light/visibility.h"

namespace sunlit::scene {
struct SurfaceState;
}

namespace sunlit::light {

class Transport;
struct TransportOptions;

/// Cheap to copy.
struct World {
  /// Flattens `scene` and builds its ray structure; bakes nothing. `meshes_of_bodies` as Bodies takes them.
  /// The world's own lamps are those of `scene`.
  explicit World(std::shared_ptr<const scene::Scene> scene,
                 const std::vector<std::vector<scene::Mesh>>& meshes_of_bodies = {});
  /// Of a scene that was flattened before, and need not have its meshes any more.
  World(std::shared_ptr<const scene::Scene> scene, std::shared_ptr<const scene::Shape> shape,
        const std::vector<std::vector<scene::Mesh>>& meshes_of_bodies);

  std::shared_ptr<const Geometry> geometry;
  std::shared_ptr<const Visibility> visibility;
  std::shared_ptr<const Bodies> bodies;  ///< what moves in it; null: nothing
  std::vector<std::vector<scene::Lamp>>
      lamps_of_bodies;                         ///< in their frames; one list a body, or none at all
  std::shared_ptr<const Transport> transport;  ///< of sky and bounced light; null: an open sky is assumed
  float ground_m = 0.0f;                       ///< z of its ground, groundLevel(), from which fog reaches up
};

/// The same world with its surfaces in another state; what moves stays dry. `dry` is so, and what it was
/// baked with is left behind. Shares its triangles and rays, and takes as long as weathering alone.
World weathered(const World& dry, const scene::SurfaceState& state);

/// Tells worlds apart by what decides their pictures: shape, looks, what moves, and how `transport` was
/// baked, if there is one. 32 hexadecimal digits; the same wherever equal contents were loaded from.
std::string fingerprint(const World& world);
/// The same before it is baked with these.
std::string fingerprint(const World& world, const TransportOptions& options);

}  // namespace sunlit::light
