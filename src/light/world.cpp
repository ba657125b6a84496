#include "sunlit/light/world.h"

#include "light/transport/bake_key.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/transport.h"

namespace sunlit::light {
namespace {

/// What only pictures show of a surface.
void addDetail(const scene::Detail& detail, image::ContentHash* hash) {
  for (const float value : {detail.contrast, detail.coarsest_m, detail.finest_m, detail.gain})
    hash->add(value);
  for (const float channel : detail.tint) hash->add(channel);
}

void addLamp(const scene::Lamp& lamp, image::ContentHash* hash) {
  for (const Eigen::Vector3f& vector : {lamp.position, lamp.direction})
    for (const float value : vector) hash->add(value);
  for (const float channel : lamp.intensity.value) hash->add(channel);
  for (const float value : {lamp.constant, lamp.linear, lamp.quadratic, lamp.range_m, lamp.inner_rad,
                            lamp.outer_rad, lamp.exponent, lamp.radius_m})
    hash->add(value);
  hash->add(static_cast<int>(lamp.relative));
  hash->add(static_cast<int>(lamp.casts_shadows));
  hash->add(std::vector<char>(lamp.group.begin(), lamp.group.end()));
}

}  // namespace

World::World(std::shared_ptr<const scene::Scene> scene,
             const std::vector<std::vector<scene::Mesh>>& meshes_of_bodies)
    : geometry(std::make_shared<Geometry>(std::move(scene))),
      visibility(std::make_shared<Visibility>(geometry)),
      bodies(meshes_of_bodies.empty() ? nullptr
                                      : std::make_shared<Bodies>(geometry->scene, meshes_of_bodies)) {}

Illumination illumination(const World& world, const sky::Daylight& day, const LampOptions& lamps) {
  Illumination light = world.transport ? world.transport->illumination(day) : Illumination(day);
  if (!burnUnder(lamps, day)) return light;
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

std::string fingerprint(const World& world) {
  image::ContentHash hash;
  if (world.transport)
    hash = bakeKey(*world.geometry, world.transport->options());
  else
    addContents(*world.geometry, &hash);
  for (const scene::Material& material : world.geometry->scene->materials) addDetail(material.detail, &hash);
  for (const scene::Lamp& lamp : world.geometry->scene->lamps) addLamp(lamp, &hash);
  if (world.bodies) {
    const std::vector<Eigen::Isometry3d> at_home(world.bodies->count(), Eigen::Isometry3d::Identity());
    addContents(*world.bodies->placed(at_home), &hash);
  }
  for (const std::vector<scene::Lamp>& of_body : world.lamps_of_bodies) {
    hash.add(static_cast<std::uint64_t>(of_body.size()));
    for (const scene::Lamp& lamp : of_body) addLamp(lamp, &hash);
  }
  return hash.text();
}

}  // namespace sunlit::light
