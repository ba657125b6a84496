/// Scenes whose light can be worked out on paper, and points of them to look at, without a renderer.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "light/picture/lighting.h"
#include "light/shading/shading.h"
#include "sunlit/light/reference.h"
#include "sunlit/light/world.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/sky/uniform_sky.h"
#include "support/patches.h"

namespace sunlit::light {

using test::addBlock;
using test::addGround;
using test::addPatch;

inline scene::Material paint(float albedo, float emission = 0.0f) {
  scene::Material material;
  material.base_color = LinearRgb(albedo, albedo, albedo);
  material.roughness = 1.0f;
  material.emission = LinearRgb(emission, emission, emission);
  return material;
}

/// A scene without triangles whose first material is a leaf's, cut out by `mask`, and whose second is opaque
/// and black.
inline scene::Scene leafSceneOf(const scene::Texture& mask) {
  scene::Scene scene;
  scene.textures.push_back(mask);
  scene::Material leaf = paint(0.3f);
  leaf.base_texture = 0;
  leaf.alpha_mode = scene::AlphaMode::kMask;
  leaf.transmission = 0.45f;
  scene.materials = {leaf, paint(0.0f)};
  return scene;
}

/// The sides of the box from `low` to `low` + `size`, seen from inside.
inline void addRoom(scene::Scene* scene, int material, const Eigen::Vector3f& low,
                    const Eigen::Vector3f& size) {
  const Eigen::Vector3f x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
  addPatch(scene, material, low, x, y);
  addPatch(scene, material, low + z, y, x);
  addPatch(scene, material, low, z, x);
  addPatch(scene, material, low + y, x, z);
  addPatch(scene, material, low, y, z);
  addPatch(scene, material, low + x, z, y);
}

inline World worldOf(scene::Scene scene) {
  return World(std::make_shared<const scene::Scene>(std::move(scene)));
}

/// A point of a surface, and from where it is looked at.
struct Looked {
  Eigen::Vector3f position;
  Eigen::Vector3f normal;
  Eigen::Vector3f to_eye;
  int material = 0;
  Eigen::Vector3f shading_normal = Eigen::Vector3f::Zero();  ///< zero: `normal`
};

/// The triangle whose plane and outline hold `point`.
inline std::uint32_t triangleAt(const Geometry& geometry, const Eigen::Vector3f& point,
                                const Eigen::Vector3f& normal) {
  for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
    const scene::Plane& plane = geometry.planes[t];
    if (std::abs(plane.normal.dot(normal)) < 0.9999f) continue;
    if (std::abs(static_cast<double>(plane.normal.dot(point)) - plane.offset) > 1e-3) continue;
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3f& a = geometry.positions[geometry.triangles[t][k]];
      const Eigen::Vector3f& b = geometry.positions[geometry.triangles[t][(k + 1) % 3]];
      inside = inside && plane.normal.dot((b - a).cross(point - a)) >= -1e-4f;
    }
    if (inside) return t;
  }
  throw std::logic_error("no triangle there");
}

/// A picture of one row, a point a pixel.
inline Surfaces rowOf(const std::vector<Looked>& points, const scene::Scene& scene) {
  Surfaces surfaces;
  surfaces.width = static_cast<int>(points.size());
  surfaces.height = 1;
  surfaces.pixel_origin = Eigen::Vector3f::UnitX();
  surfaces.pixel_right = Eigen::Vector3f(0.0f, -1e-3f, 0.0f);
  surfaces.pixel_down = Eigen::Vector3f(0.0f, 0.0f, -1e-3f);
  for (std::size_t i = 0; i < points.size(); i += Surfaces::kTileSize) {
    Tile tile;
    tile.x = static_cast<int>(i);
    tile.width = std::min(Surfaces::kTileSize, surfaces.width - tile.x);
    tile.height = 1;
    tile.sky.assign(static_cast<std::size_t>(tile.width), 0);
    for (std::size_t k = i; k < i + static_cast<std::size_t>(tile.width); ++k) {
      Surface surface;
      surface.position = points[k].position;
      surface.to_eye = points[k].to_eye.normalized();
      surface.geometric_normal = points[k].normal;
      surface.shading_normal =
          points[k].shading_normal.isZero() ? points[k].normal : points[k].shading_normal;
      surface.material = points[k].material;
      const scene::Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
      surface.albedo = material.base_color.value;
      surface.emission = material.emission.value;
      surface.roughness = material.roughness;
      surface.metalness = material.metalness;
      surface.clearance_m = 3e-4f;
      surface.pixel = static_cast<std::uint32_t>(k);
      surface.first_sample = static_cast<std::uint32_t>(tile.origin_x.size());
      surface.samples = 1;
      const Eigen::Vector3f origin = surface.position + surface.clearance_m * surface.geometric_normal;
      tile.origin_x.push_back(origin.x());
      tile.origin_y.push_back(origin.y());
      tile.origin_z.push_back(origin.z());
      tile.surfaces.push_back(surface);
    }
    surfaces.tiles.push_back(tile);
  }
  return surfaces;
}

/// The green of each pixel of a row, cd/m².
inline std::vector<double> rowValues(const image::LinearImage& image) {
  std::vector<double> values;
  for (int x = 0; x < image.width; ++x) values.push_back(static_cast<double>(image.at(x, 0)[1]));
  return values;
}

/// What surfaces have around them, as far as the light of `world` is baked.
inline Outlooks outlooksOf(const Surfaces& surfaces, const World& world, FinalGather* gather = nullptr) {
  Outlooks outlooks;
  findOutlooks(surfaces, {world, *world.visibility, nullptr, gather}, &outlooks);
  return outlooks;
}

/// Of surfaces that have these around them, without what they mirror by rays.
inline image::LinearImage pictureOf(const Surfaces& surfaces, const Outlooks& outlooks, const World& world,
                                    const Illumination& light) {
  const scene::Scene& scene = *world.geometry->scene;
  ReadyPicture ready;
  ready.seen = {surfaces, outlooks, LightTable(surfaces, outlooks, scene)};
  return illuminate(ready, scene, *world.visibility, light);
}
inline std::vector<double> rowValues(const Surfaces& surfaces, const Outlooks& outlooks, const World& world,
                                     const Illumination& light) {
  return rowValues(pictureOf(surfaces, outlooks, world, light));
}
inline std::vector<double> rowValues(const Surfaces& surfaces, const World& world,
                                     const Illumination& light) {
  return rowValues(surfaces, outlooksOf(surfaces, world), world, light);
}

inline image::LinearImage tracedPicture(const World& world, const std::vector<Looked>& points,
                                        const sky::Daylight& day, int samples, int bounces = 64) {
  const Surfaces surfaces = rowOf(points, *world.geometry->scene);
  ReferenceOptions options;
  options.samples_per_pixel = samples;
  options.bounces = bounces;
  return traceReference(surfaces, world, {day}, options)[0].luminance;
}
inline std::vector<double> traced(const World& world, const std::vector<Looked>& points,
                                  const sky::Daylight& day, int samples, int bounces = 64) {
  return rowValues(tracedPicture(world, points, day, samples, bounces));
}

inline sky::Daylight uniformDay(float luminance, double ground_albedo = 0.0) {
  sky::UniformSky sky;
  sky.luminance = LinearRgb(luminance, luminance, luminance);
  sky.ground_albedo = ground_albedo;
  return sky::uniformDaylight(sky);
}

/// A sun of 1 lx and nothing else.
inline sky::Daylight onlySun(double azimuth_deg, double elevation_deg) {
  sky::UniformSky sky;
  sky.sun.towards = Direction(Azimuth::degrees(azimuth_deg), Angle::degrees(elevation_deg));
  sky.sun.illuminance = LinearRgb(1.0f, 1.0f, 1.0f);
  return sky::uniformDaylight(sky);
}

/// Luminance that `material` shows in the direction of `to_eye` where light of 1 cd/m² comes from all
/// directions that `open` lets through, by a sum over the sphere. Frame: z along the normal.
template <typename Open>
double underSky(const scene::Material& material, const Eigen::Vector3f& to_eye, const Open& open) {
  constexpr int kRings = 400, kSectors = 800;
  const Reflection reflection{Eigen::Vector3f::UnitZ(), to_eye.normalized(), material.base_color.value,
                              material.roughness,       material.metalness,  material.transmission};
  double sum = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double z = 2.0 * (i + 0.5) / kRings - 1.0;
    const double across = std::sqrt(1.0 - z * z);
    for (int k = 0; k < kSectors; ++k) {
      const double turn = 2.0 * kPi * (k + 0.5) / kSectors;
      const Eigen::Vector3f towards =
          Eigen::Vector3d(across * std::cos(turn), across * std::sin(turn), z).cast<float>();
      if (open(towards)) sum += static_cast<double>(directReflectance(reflection, towards, 0.0f)[1]);
    }
  }
  return sum * 4.0 * kPi / (kRings * kSectors);
}

/// Of matt paint, as light comes back from it on average.
inline double albedoOf(float base) {
  const Reflection reflection{Eigen::Vector3f::UnitZ(), Eigen::Vector3f(0.77f, 0.0f, 0.64f),
                              Eigen::Array3f::Constant(base), 1.0f, 0.0f};
  const AmbientReflectance ambient = ambientReflectance(reflection);
  return static_cast<double>(ambient.diffuse[1] * kPiFloat + ambient.specular[1]);
}

inline bool everywhere(const Eigen::Vector3f&) {
  return true;
}

inline double albedoTowards(const scene::Material& material, const Eigen::Vector3f& to_eye) {
  return underSky(material, to_eye, everywhere);
}

}  // namespace sunlit::light
