#include "sunlit/light/world.h"

#include "sunlit/light/illumination.h"
#include "sunlit/light/transport.h"

namespace sunlit::light {

World::World(std::shared_ptr<const scene::Scene> scene,
             const std::vector<std::vector<scene::Mesh>>& meshes_of_bodies)
    : geometry(std::make_shared<Geometry>(std::move(scene))),
      visibility(std::make_shared<Visibility>(geometry)),
      bodies(meshes_of_bodies.empty() ? nullptr
                                      : std::make_shared<Bodies>(geometry->scene, meshes_of_bodies)) {}

Illumination illumination(const World& world, const sky::Daylight& day) {
  return world.transport ? world.transport->illumination(day) : Illumination(day);
}

}  // namespace sunlit::light
