/// All triangles of a scene in one list, ordered so that neighbours in the list share a material and a place.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "sunlit/scene/scene.h"

namespace sunlit::scene {
class Weathering;
}

namespace sunlit::light {

/// The plane that a triangle lies in: points p with normal · p = offset.
struct Plane {
  Eigen::Vector3f normal;  ///< unit, to the front side, in `map`
  double offset = 0.0;     ///< m; of the rounded normal, so that the plane goes through the triangle exactly
};

/// The plane of a triangle, whose front runs counter-clockwise; none if it has no area.
std::optional<Plane> planeThrough(const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                                  const Eigen::Vector3f& c);

/// Consecutive triangles of one material within one cell of a square grid over the map: the unit of culling.
struct Chunk {
  int material = 0;         ///< index into Scene::materials
  std::uint32_t first = 0;  ///< first triangle
  std::uint32_t count = 0;  ///< triangles, > 0
  Eigen::AlignedBox3f box;  ///< around all of them, m in `map`
};

/// Where the triangles of a scene are and what they are made of. Triangles without area are left out: they
/// can neither be seen nor cast a shadow.
struct Shape {
  explicit Shape(const scene::Scene& scene);

  std::vector<Eigen::Vector3f> positions;  ///< m in `map`
  std::vector<Eigen::Vector3f>
      normals;  ///< of the file, in `map`; unit, or zero where the file's is unusable
  std::vector<Eigen::Vector2f> texture_coordinates;  ///< one a vertex; zero where the mesh has none
  /// Of sets 1 … of scene::TextureUse::coordinates; zero where a mesh lacks one. Empty if no mesh has any.
  std::vector<std::vector<Eigen::Vector2f>> more_texture_coordinates;
  /// Of scene::Mesh, in `map`; zero where a mesh has none. Empty if no mesh has any.
  std::vector<Eigen::Vector4f> tangents;
  std::vector<Eigen::Array3f> colors;  ///< linear, one a vertex

  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Plane> planes;            ///< one a triangle
  std::vector<std::int32_t> materials;  ///< one a triangle
  std::vector<Chunk> chunks;            ///< cover all triangles, in order

  static constexpr float kCellSize_m = 64.0f;
};

/// A scene's triangles in one state of their surfaces. Cheap to copy: copies, and other states, share the
/// shape.
struct Geometry {
  explicit Geometry(std::shared_ptr<const scene::Scene> scene);
  /// Of a shape that has the materials of `scene`.
  Geometry(std::shared_ptr<const scene::Scene> scene, std::shared_ptr<const Shape> shape);

  std::shared_ptr<const scene::Scene> scene;  ///< whose materials and textures the indices below mean
  std::shared_ptr<const scene::Weathering> weathering;  ///< what lies on its surfaces; null: nothing
  std::shared_ptr<const Shape> shape;                   ///< whose all that follows is

  const std::vector<Eigen::Vector3f>& positions;
  const std::vector<Eigen::Vector3f>& normals;
  const std::vector<Eigen::Vector2f>& texture_coordinates;
  const std::vector<std::vector<Eigen::Vector2f>>& more_texture_coordinates;
  const std::vector<Eigen::Vector4f>& tangents;
  const std::vector<Eigen::Array3f>& colors;
  const std::vector<std::array<std::uint32_t, 3>>& triangles;
  const std::vector<Plane>& planes;
  const std::vector<std::int32_t>& materials;
  const std::vector<Chunk>& chunks;

  /// Of a set of scene::TextureUse: one a vertex; null: no mesh has it.
  const std::vector<Eigen::Vector2f>* coordinates(int set) const {
    if (set == 0) return &texture_coordinates;
    const auto more = static_cast<std::size_t>(set - 1);
    return more < more_texture_coordinates.size() ? &more_texture_coordinates[more] : nullptr;
  }
};

}  // namespace sunlit::light
