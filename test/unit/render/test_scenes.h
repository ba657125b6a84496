/// Hand-made scenes with answers that can be worked out on paper.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "sunlit/light/luminance_error.h"
#include "sunlit/light/reference.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/render/renderer.h"
#include "sunlit/scene/scene.h"
#include "sunlit/sky/atmosphere.h"
#include "support/patches.h"
#include "support/usual_air.h"

namespace sunlit::test {

inline int addMaterial(scene::Scene* scene, const Eigen::Array3f& base_color) {
  scene::Material material;
  material.name = "material " + std::to_string(scene->materials.size());
  material.base_color = LinearRgb(base_color);
  material.roughness = 1.0f;
  scene->materials.push_back(material);
  return static_cast<int>(scene->materials.size()) - 1;
}

/// A camera at `eye` whose optical axis points at `target`, upright.
inline Eigen::Isometry3d lookingAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  const Eigen::Vector3d z = (target - eye).normalized();
  const Eigen::Vector3d world_up =
      std::abs(z.z()) > 0.999 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d x = z.cross(world_up).normalized();
  Eigen::Isometry3d map_from_optical = Eigen::Isometry3d::Identity();
  map_from_optical.linear().col(0) = x;
  map_from_optical.linear().col(1) = z.cross(x);
  map_from_optical.linear().col(2) = z;
  map_from_optical.translation() = eye;
  return map_from_optical;
}

inline render::RenderOptions smallCamera(int width = 160, int height = 120, double fov_deg = 60.0) {
  render::RenderOptions options;
  options.camera = image::PinholeCamera::fromFieldOfView(width, height, Angle::degrees(fov_deg));
  return options;
}

inline sky::Daylight daylightAt(double azimuth_deg, double elevation_deg) {
  return sky::usualAir().daylight(
      {Direction(Azimuth::degrees(azimuth_deg), Angle::degrees(elevation_deg)), 1.0});
}

inline std::shared_ptr<const scene::Scene> shared(scene::Scene scene) {
  return std::make_shared<const scene::Scene>(std::move(scene));
}

inline Eigen::Array3f at(const image::LinearImage& image, int x, int y) {
  return Eigen::Map<const Eigen::Array3f>(image.at(x, y));
}

/// What skylight alone makes of a rough dielectric, relative error allowed to what uses it: see each test.
inline Eigen::Array3f skyPart(const sky::Daylight& day, const Eigen::Vector3f& normal,
                              const Eigen::Array3f& albedo) {
  return albedo / kPiFloat * day.skyIlluminance(normal).value;
}

/// A yard: ground, two walls that meet, a roof on a wall, and a box.
inline scene::Scene yard() {
  scene::Scene scene;
  const int ground = addMaterial(&scene, {0.3f, 0.3f, 0.28f});
  const int wall = addMaterial(&scene, {0.6f, 0.5f, 0.4f});
  const int box = addMaterial(&scene, {0.5f, 0.15f, 0.1f});
  scene.materials[static_cast<std::size_t>(ground)].roughness = 0.85f;
  scene.materials[static_cast<std::size_t>(box)].roughness = 0.5f;
  addGround(&scene, ground, 60.0f);
  addBlock(&scene, wall, {8.0f, -12.0f, 0.0f}, {0.5f, 20.0f, 5.0f});
  addBlock(&scene, wall, {-6.0f, 8.0f, 0.0f}, {14.5f, 0.5f, 4.0f});
  addBlock(&scene, wall, {5.0f, -4.0f, 3.5f}, {3.0f, 6.0f, 0.2f});
  addBlock(&scene, box, {2.0f, 3.0f, 0.0f}, {2.0f, 2.0f, 1.5f});
  return scene;
}

/// Of a picture of 64 × 48 px, against light traced by so many paths a pixel.
inline std::vector<light::LuminanceError> errorsAgainstTraced(const light::World& world,
                                                              const Eigen::Isometry3d& map_from_optical,
                                                              const std::vector<sky::Daylight>& days,
                                                              int samples_per_pixel) {
  render::Renderer renderer(world, smallCamera(64, 48, 90.0));
  renderer.look(map_from_optical);
  light::ReferenceOptions reference;
  reference.samples_per_pixel = samples_per_pixel;
  const std::vector<light::Traced> traced =
      light::traceReference(renderer.surfaces(), world, days, reference);
  std::vector<light::LuminanceError> errors;
  for (std::size_t i = 0; i < days.size(); ++i)
    errors.push_back(light::luminanceError(renderer.light(light::illumination(world, days[i])), traced[i],
                                           renderer.surfaces()));
  return errors;
}

/// The same under suns of these elevations.
inline std::vector<light::LuminanceError> errorsAgainstTraced(const light::World& world,
                                                              const Eigen::Isometry3d& map_from_optical,
                                                              const std::vector<double>& elevations_deg,
                                                              int samples_per_pixel) {
  std::vector<sky::Daylight> days;
  for (const double elevation : elevations_deg) days.push_back(daylightAt(230.0, elevation));
  return errorsAgainstTraced(world, map_from_optical, days, samples_per_pixel);
}

}  // namespace sunlit::test
