#include "light/picture/bodies/body_light.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "light/bake/samples/transport_data.h"
#include "light/geometry/corners.h"
#include "light/geometry/ray_list.h"
#include "light/lamps/beams_of_light.h"
#include "light/patches/even_directions.h"
#include "light/picture/bodies/body_shade.h"
#include "light/picture/bodies/lamps_on_places.h"
#include "light/picture/disc/floor_mirror.h"
#include "light/shading/polished_floor.h"
#include "light/shading/reflectances.h"
#include "sunlit/light/transport.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

/// They stand still in `map`, so that a body that turns sees the same.
constexpr int kDirections = 256;

/// Where a ray from the middle of a body met the scene.
struct Met {
  std::uint32_t body;
  std::uint32_t direction;
  Eigen::Array3f reflectance;
  Eigen::Array3f emission;  ///< luminance of its own, cd/m²; 0 of lamps' glass and small sources, which light
                            ///< straight
  Eigen::Vector3f normal;  ///< on the side that was met
  Eigen::Vector3f origin;  ///< of shadow rays: clear of the surface
  LightPlace light;
};

}  // namespace

struct BodyLight::Views {
  std::shared_ptr<const Visibility> visibility;
  std::size_t bodies = 0;
  std::vector<std::array<std::uint32_t, 2>> open;  ///< body and direction of rays that met nothing
  std::vector<Met> met;
};

class BodyLight::Implementation {
 public:
  explicit Implementation(const World& world)
      : world_(world), reflectances_(*world.geometry), directions_(evenDirections(kDirections)) {}

  std::shared_ptr<const Views> look(const Geometry& bodies,
                                    std::shared_ptr<const Visibility> visibility) const;
  std::vector<AroundLight> around(const Views& views, const Illumination& light) const;
  const Bodies& bodies() const { return *world_.bodies; }

 private:
  void castFrom(std::uint32_t body, const Eigen::Vector3f& middle, Views* views) const;
  Eigen::Array3f reflectanceAt(const TriangleSide& side, const Eigen::Vector3f& barycentric) const {
    return meanReflectance(reflectances_.at(side, barycentric)).all();
  }
  void keep(std::uint32_t body, std::uint32_t direction, const Hit& hit, Views* views) const;
  bool isOfCompactSource(const Eigen::Vector3f& position) const {
    if (!world_.transport || !world_.transport->compactSources()) return false;
    const std::vector<CompactSource>& sources = *world_.transport->compactSources();
    return std::any_of(sources.begin(), sources.end(), [&](const CompactSource& source) {
      return (position - source.position).norm() <= source.reach_m;
    });
  }
  static Eigen::Array3f arriving(const Met& met, const Illumination& light);
  /// Adds the light of a disc to the illuminance of each place that it reaches.
  static void addDisc(const Views& views, const sky::Daylight& day, const sky::DiscLight& disc,
                      std::vector<Eigen::Array3f>* illuminance);
  /// The same by way of polished floors, where nodes lack that light.
  static void addGlints(const Views& views, const Illumination& light, const sky::DiscLight& disc,
                        std::vector<Eigen::Array3f>* illuminance);
  /// The same of lamps, and of surfaces that pass their light on. To be called last: those that matter little
  /// beside what is there are left out.
  static void addLamps(const Views& views, const Illumination& light,
                       std::vector<Eigen::Array3f>* illuminance);

  World world_;
  Reflectances reflectances_;
  std::vector<Eigen::Vector3f> directions_;
};

void BodyLight::Implementation::keep(std::uint32_t body, std::uint32_t direction, const Hit& hit,
                                     Views* views) const {
  const Geometry& geometry = *world_.geometry;
  const Eigen::Vector3f weights(1.0f - hit.u - hit.v, hit.u, hit.v);
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  for (int k = 0; k < 3; ++k) {
    position +=
        weights[k] * geometry.positions[geometry.triangles[hit.triangle][static_cast<std::size_t>(k)]];
  }
  const Eigen::Vector3f& plane_normal = geometry.planes[hit.triangle].normal;
  const bool front = plane_normal.dot(directions_[direction]) < 0.0f;
  const Eigen::Vector3f normal = front ? plane_normal : Eigen::Vector3f(-plane_normal);
  const float clear = 1e-3f + 1e-6f * position.cwiseAbs().maxCoeff();
  LightPlace light;
  if (world_.transport) {
    const std::array<float, 3> within = Corners(geometry, hit.triangle).within(position);
    light = lightPlace(world_.transport->data().mesh, {hit.triangle, front}, within);
  }
  const scene::Material& material =
      geometry.scene->materials[static_cast<std::size_t>(geometry.materials[hit.triangle])];
  Eigen::Array3f emission = Eigen::Array3f::Zero();
  if (material.lamp_group.empty() && (front || material.double_sided) && !isOfCompactSource(position))
    emission = reflectances_.emissionAt(hit.triangle, weights);
  views->met.push_back({body, direction, reflectanceAt({hit.triangle, front}, weights), emission, normal,
                        position + clear * normal, light});
}

void BodyLight::Implementation::castFrom(std::uint32_t body, const Eigen::Vector3f& middle,
                                         Views* views) const {
  std::vector<float> ox(kDirections, middle.x()), oy(kDirections, middle.y()), oz(kDirections, middle.z());
  std::vector<float> dx, dy, dz;
  for (const Eigen::Vector3f& direction : directions_) {
    dx.push_back(direction.x());
    dy.push_back(direction.y());
    dz.push_back(direction.z());
  }
  std::vector<Hit> hits(kDirections);
  world_.visibility->closest({ox.data(), oy.data(), oz.data(), dx.data(), dy.data(), dz.data(), hits.size()},
                             hits.data());
  for (std::uint32_t i = 0; i < hits.size(); ++i) {
    if (hits[i].triangle == Hit::kMiss) {
      views->open.push_back({body, i});
    } else {
      keep(body, i, hits[i], views);
    }
  }
}

std::shared_ptr<const BodyLight::Views> BodyLight::Implementation::look(
    const Geometry& bodies, std::shared_ptr<const Visibility> visibility) const {
  auto views = std::make_shared<Views>();
  views->visibility = std::move(visibility);
  views->bodies = world_.bodies->count();
  for (std::uint32_t body = 0; body < views->bodies; ++body) {
    const Eigen::AlignedBox3f box = world_.bodies->boxOf(body, bodies);
    if (!box.isEmpty()) castFrom(body, box.center(), views.get());
  }
  return views;
}

/// Sky light and bounced light at a place that was met, lx.
Eigen::Array3f BodyLight::Implementation::arriving(const Met& met, const Illumination& light) {
  if (!light.nodes || !met.light.known()) return light.day.skyIlluminance(met.normal).value;
  return irradianceAt(met.light, *light.nodes);
}

void BodyLight::Implementation::addDisc(const Views& views, const sky::Daylight& day,
                                        const sky::DiscLight& disc,
                                        std::vector<Eigen::Array3f>* illuminance) {
  if (!(disc.illuminance.value.maxCoeff() > 0.0f)) return;
  const Eigen::Vector3f towards = disc.towards.vector().cast<float>();
  const std::size_t count = views.met.size();
  std::vector<float> ox, oy, oz;
  for (const Met& met : views.met) {
    ox.push_back(met.origin.x());
    oy.push_back(met.origin.y());
    oz.push_back(met.origin.z());
  }
  const std::vector<float> dx(count, towards.x()), dy(count, towards.y()), dz(count, towards.z());
  std::vector<std::uint8_t> blocked(count, 0);
  views.visibility->occluded({ox.data(), oy.data(), oz.data(), dx.data(), dy.data(), dz.data(), count},
                             blocked.data());
  for (std::size_t i = 0; i < count; ++i) {
    const float cosine = views.met[i].normal.dot(towards);
    if (!blocked[i] && cosine > 0.0f)
      (*illuminance)[i] += cosine * day.throughCloud(disc, views.met[i].origin) * disc.illuminance.value;
  }
}

void BodyLight::Implementation::addGlints(const Views& views, const Illumination& light,
                                          const sky::DiscLight& disc,
                                          std::vector<Eigen::Array3f>* illuminance) {
  if (!light.glint_nodes || !(disc.illuminance.value.maxCoeff() > 0.0f)) return;
  const GlintNodes& nodes = *light.glint_nodes;
  const Eigen::Vector3f to_disc = disc.towards.vector().cast<float>(), down = FloorMirror::mirrored(to_disc);
  const FloorMirror mirror(*views.visibility, to_disc, 0.0f);
  RayList rays;
  rays.reserve(views.met.size());
  for (std::uint32_t i = 0; i < views.met.size(); ++i)
    if (nodes.at(views.met[i].light) * views.met[i].normal.dot(down) > 0.0f)
      rays.add(i, views.met[i].origin, down);
  std::vector<std::uint8_t> stopped(rays.size(), 1);
  mirror.stopped(rays.rays(), stopped.data());
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const std::uint32_t i = rays.number()[k];
    const Met& met = views.met[i];
    if (stopped[k] != 0) continue;
    const auto floor = mirror.floorAlong(met.origin, down);
    if (floor) {
      (*illuminance)[i] += nodes.at(met.light) * met.normal.dot(down) *
                           light.day.throughCloud(disc, met.origin) * disc.illuminance.value *
                           mirroredShare(*floor, to_disc.z());
    }
  }
}

void BodyLight::Implementation::addLamps(const Views& views, const Illumination& light,
                                         std::vector<Eigen::Array3f>* illuminance) {
  const std::vector<LampBeam> beams = beamsOf(light);
  if (beams.empty()) return;
  std::vector<LitPlace> places;
  for (const Met& met : views.met) places.push_back({met.origin, met.normal});
  addLampLight({beams, *views.visibility}, places, illuminance);
}

std::vector<AroundLight> BodyLight::Implementation::around(const Views& views,
                                                           const Illumination& light) const {
  constexpr float kSolidAngle = 4.0f * kPiFloat / kDirections;
  std::vector<AroundLight> lights(views.bodies);
  for (const auto& [body, direction] : views.open) {
    const Eigen::Vector3f& towards = directions_[direction];
    lights[body].add(towards, kSolidAngle, light.day.skyLuminance(towards).value);
  }
  std::vector<Eigen::Array3f> illuminance;
  for (const Met& met : views.met) illuminance.push_back(arriving(met, light));
  for (const sky::DiscLight* disc : {&light.day.sun(), &light.day.moon()}) {
    addDisc(views, light.day, *disc, &illuminance);
    addGlints(views, light, *disc, &illuminance);
  }
  addLamps(views, light, &illuminance);
  for (std::size_t i = 0; i < views.met.size(); ++i) {
    const Met& met = views.met[i];
    lights[met.body].add(directions_[met.direction], kSolidAngle,
                         illuminance[i] * met.reflectance / kPiFloat + met.emission);
  }
  return lights;
}

BodyLight::BodyLight(const World& world) : implementation_(std::make_unique<Implementation>(world)) {}
BodyLight::~BodyLight() = default;

std::shared_ptr<const BodyLight::Views> BodyLight::look(const Geometry& bodies,
                                                        std::shared_ptr<const Visibility> visibility) const {
  return implementation_->look(bodies, std::move(visibility));
}

std::vector<AroundLight> BodyLight::around(const Views& views, const Illumination& light) const {
  return implementation_->around(views, light);
}

void BodyLight::hide(const Surfaces& surfaces, const Visibility& visibility, Outlooks* outlooks) const {
  const BodyShade shade(implementation_->bodies(), *visibility.movingGeometry(), visibility);
  tbb::parallel_for(std::size_t{0}, surfaces.tiles.size(),
                    [&](std::size_t i) { shade.apply(surfaces.tiles[i], &(*outlooks)[i]); });
}

}  // namespace sunlit::light
