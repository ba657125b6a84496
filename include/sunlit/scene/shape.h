/// All triangles of a scene in one list, ordered so that neighbours in the list share a material and a place.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "sunlit/image/kept_array.h"
#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// The plane that a triangle lies in: points p with normal · p = offset.
struct Plane {
  Eigen::Vector3f normal;        ///< unit, to the front side, in `map`
  std::uint32_t no_meaning = 0;  ///< where padding would be, so that equal planes have equal bytes
  double offset = 0.0;  ///< m; of the rounded normal, so that the plane goes through the triangle exactly

  /// How far a point is before its front side, m.
  double height(const Eigen::Vector3f& point) const {
    return normal.cast<double>().dot(point.cast<double>()) - offset;
  }
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
  Shape() = default;
  explicit Shape(const Scene& scene);

  /// m in `map`. Memory goes on behind the last one by a number at least, for ray libraries that read four at
  /// a time: copies call makeRoomBehind().
  image::KeptArray<Eigen::Vector3f> positions;
  image::KeptArray<Eigen::Vector3f>
      normals;  ///< of the file, in `map`; unit, or zero where the file's is unusable
  image::KeptArray<Eigen::Vector2f> texture_coordinates;  ///< one a vertex; zero where the mesh has none
  /// Of sets 1 … of scene::TextureUse::coordinates; zero where a mesh lacks one. Empty if no mesh has any.
  std::vector<image::KeptArray<Eigen::Vector2f>> more_texture_coordinates;
  /// Of scene::Mesh, in `map`; zero where a mesh has none. Empty if no mesh has any.
  image::KeptArray<Eigen::Vector4f> tangents;
  image::KeptArray<Eigen::Array3f> colors;  ///< linear, one a vertex

  image::KeptArray<std::array<std::uint32_t, 3>> triangles;
  image::KeptArray<Plane> planes;            ///< one a triangle
  image::KeptArray<std::int32_t> materials;  ///< one a triangle
  image::KeptArray<Chunk> chunks;            ///< cover all triangles, in order

  static constexpr float kCellSize_m = 64.0f;

  void makeRoomBehind();
};

/// A scene whose meshes became a shape: it has none itself.
struct FlatScene {
  Scene scene;
  Shape shape;
};
FlatScene flattened(Scene scene);

}  // namespace sunlit::scene
