#include "sunlit/light/world.h"

#include <utility>

#include "light/bake/cache/bake_key.h"
#include "light/lamps/lamp_sets.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/land.h"
#include "sunlit/light/transport.h"
#include "sunlit/scene/scene_bytes.h"
#include "sunlit/scene/weathering.h"

namespace sunlit::light {
World::World(std::shared_ptr<const scene::Scene> scene,
             const std::vector<std::vector<scene::Mesh>>& meshes_of_bodies)
    : World(scene, std::make_shared<const scene::Shape>(*scene), meshes_of_bodies) {}

World::World(std::shared_ptr<const scene::Scene> scene, std::shared_ptr<const scene::Shape> shape,
             const std::vector<std::vector<scene::Mesh>>& meshes_of_bodies)
    : geometry(std::make_shared<Geometry>(std::move(scene), std::move(shape))),
      visibility(std::make_shared<Visibility>(geometry)),
      bodies(meshes_of_bodies.empty() ? nullptr
                                      : std::make_shared<Bodies>(geometry->scene, meshes_of_bodies)),
      ground_m(groundLevel(*geometry, *visibility)) {}

World weathered(const World& dry, const scene::SurfaceState& state) {
  World world = dry;
  world.transport = nullptr;
  if (scene::isDry(state)) return world;
  auto geometry = std::make_shared<Geometry>(*dry.geometry);
  geometry->weathering =
      std::make_shared<const scene::Weathering>(*geometry->shape, geometry->scene->materials, state);
  world.geometry = std::move(geometry);
  world.visibility = std::make_shared<Visibility>(*dry.visibility, world.geometry);
  return world;
}

Illumination illumination(const World& world, const sky::Daylight& day, const LampOptions& lamps) {
  const bool burn = burnUnder(lamps, day);
  const std::vector<float> shares =
      burn ? burningShares(world.geometry->scene->lamps, lamps) : std::vector<float>();
  const sky::Daylight here = day.overGround(world.ground_m);
  Illumination light = world.transport ? world.transport->illumination(here, shares, world.visibility.get())
                                       : Illumination(here);
  if (!burn) return light;
  light.lamps =
      std::make_shared<const std::vector<scene::Lamp>>(burning(world.geometry->scene->lamps, lamps));
  std::vector<BodyLamp> of_bodies;
  for (std::uint32_t body = 0; body < world.lamps_of_bodies.size(); ++body) {
    for (scene::Lamp& lamp : burning(world.lamps_of_bodies[body], lamps))
      of_bodies.push_back({body, std::move(lamp)});
  }
  light.body_lamps = std::make_shared<const std::vector<BodyLamp>>(std::move(of_bodies));
  return light;
}

namespace {

/// `hash`: of what a bake depends on.
std::string withLooks(const World& world, image::ContentHash hash) {
  // With what only pictures show, and a bake need not know: tangents, and all looks.
  hash.add(world.geometry->tangents);
  scene::writeLooks(*world.geometry->scene,
                    [&hash](const void* data, std::size_t size) { hash.addBytes(data, size); });
  scene::letGoOfTexels(*world.geometry->scene);
  if (world.bodies) {
    const std::vector<Eigen::Isometry3d> at_home(world.bodies->count(), Eigen::Isometry3d::Identity());
    const auto bodies = world.bodies->placed(at_home);
    addContents(*bodies, &hash);
    hash.add(bodies->tangents);
  }
  for (const std::vector<scene::Lamp>& of_body : world.lamps_of_bodies) {
    hash.add(static_cast<std::uint64_t>(of_body.size()));
    addLamps(of_body, &hash);
  }
  return hash.text();
}

}  // namespace

std::string fingerprint(const World& world, const TransportOptions& options) {
  return withLooks(world, bakeKey(*world.geometry, options));
}

std::string fingerprint(const World& world) {
  if (world.transport) return fingerprint(world, world.transport->options());
  image::ContentHash hash;
  addContents(*world.geometry, &hash);
  return withLooks(world, std::move(hash));
}

}  // namespace sunlit::light
