#include "render/weather_surfaces.h"
#include "sunlit/scene/weathering.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace sunlit::render {
namespace {

/// How wide a pixel is on a surface, m, as the mean of both its sides.
float footprint_m(const light::Surface& surface, const Eigen::Vector3f& eye, float pixel_rad) {
  constexpr float kGrazing = 0.02f;
  const float facing = std::max(surface.geometric_normal.dot(surface.to_eye), kGrazing);
  return (surface.position - eye).norm() * pixel_rad / std::sqrt(facing);
}

}  // namespace

void weatherSurfaces(const light::Geometry& geometry, light::Surfaces* surfaces) {
  if (!geometry.weathering) return;
  const float pixel_rad = surfaces->pixel_right.norm();
  const Eigen::Vector3f eye = surfaces->eye;
  tbb::parallel_for(std::size_t{0}, surfaces->tiles.size(), [&](std::size_t i) {
    for (light::Surface& surface : surfaces->tiles[i].surfaces) {
      if (surface.triangle >= geometry.triangles.size()) continue;  // what moves
      scene::Weathering::Look look{surface.albedo, surface.shading_normal, surface.roughness,
                                   surface.metalness};
      geometry.weathering->apply(
          {surface.position, surface.geometric_normal, footprint_m(surface, eye, pixel_rad)},
          geometry.scene->materials[static_cast<std::size_t>(surface.material)], &look);
      surface.albedo = look.albedo;
      surface.shading_normal = look.normal;
      surface.roughness = look.roughness;
      surface.metalness = look.metalness;
      surface.film = look.film;
    }
  });
}

}  // namespace sunlit::render
