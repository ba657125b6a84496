#include "sunlit/light/world.h"

namespace sunlit::light {

World::World(std::shared_ptr<const scene::Scene> scene)
    : geometry(std::make_shared<Geometry>(std::move(scene))),
      visibility(std::make_shared<Visibility>(geometry)) {}

}  // namespace sunlit::light
