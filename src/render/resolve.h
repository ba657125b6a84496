/// From the geometry buffer to surfaces that can be lit, and to depth.
#pragma once

#include <vector>

#include "render/sample.h"
#include "render/surface_maps.h"
#include "render/texture_pyramid.h"
#include "render/view.h"
#include "sunlit/image/images.h"
#include "sunlit/light/geometry.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"

namespace sunlit::render {

/// A geometry buffer with what it was drawn from.
struct Seen {
  const View& view;
  const light::Geometry& geometry;
  const light::Geometry* bodies;    ///< what moves, its triangles numbered after those of `geometry`; or null
  const TexturePyramids& pyramids;  ///< of the scene
  const SurfaceMaps& maps;          ///< of the scene
  float lod_bias;                   ///< levels
  const std::vector<Sample>& samples;
  const light::Visibility* veils;  ///< knows what is seen through; null: nothing is

  const scene::Plane& plane(std::uint32_t triangle) const {
    return of(triangle).planes[triangle - before(triangle)];
  }
  std::int32_t material(std::uint32_t triangle) const {
    return of(triangle).materials[triangle - before(triangle)];
  }
  /// Materials are those of the fixed scene, also of what moves.
  const scene::Material& look(std::int32_t of_material) const {
    return geometry.scene->materials[static_cast<std::size_t>(of_material)];
  }
  const Eigen::Vector3f& corner(std::uint32_t triangle, std::size_t i) const {
    return of(triangle).positions[of(triangle).triangles[triangle - before(triangle)][i]];
  }
  bool moves(std::uint32_t triangle) const { return triangle >= geometry.triangles.size(); }

  const Sample& sample(int column, int row) const {
    return samples[static_cast<std::size_t>(row) *
                       static_cast<std::size_t>(view.camera.width * view.supersampling) +
                   static_cast<std::size_t>(column)];
  }

  const light::Geometry& of(std::uint32_t triangle) const { return moves(triangle) ? *bodies : geometry; }
  std::uint32_t before(std::uint32_t triangle) const {
    return moves(triangle) ? static_cast<std::uint32_t>(geometry.triangles.size()) : 0;
  }
};

/// Depth along `ray` (see View::ray) at which it meets the plane of `triangle`; not finite if it runs within
/// it.
double planeDepth(const Seen& seen, std::uint32_t triangle, const Eigen::Vector3d& ray);

/// Whether `ray` from the eye passes through the triangle: it then lies on the same side of all three edges.
/// Exact on shared edges up to rounding, which counts as inside.
bool passesThrough(const Seen& seen, std::uint32_t triangle, const Eigen::Vector3d& ray);

/// Samples of a pixel that look alike become one surface. Reuses the memory of `surfaces`.
void resolveSurfaces(const Seen& seen, light::Surfaces* surfaces);

/// Depth at the pixel centres, where no sample lies if supersampling is even: of the nearest triangle among
/// those that the pixel's samples see and that contains the centre; if none does, of what a ray through the
/// centre meets first.
image::DepthImage resolveDepth(const Seen& seen, const light::Visibility& visibility);

}  // namespace sunlit::render
