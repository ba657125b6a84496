/// What rays and pictures know of a scene: where its triangles are, and what they look like.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "sunlit/image/kept_array.h"
#include "sunlit/scene/scene.h"
#include "sunlit/scene/shape.h"

namespace sunlit::scene {
class Weathering;
}

namespace sunlit::light {

/// A scene's triangles in one state of their surfaces. Cheap to copy: copies, and other states, share the
/// shape.
struct Geometry {
  explicit Geometry(std::shared_ptr<const scene::Scene> scene);
  /// Of a shape that has the materials of `scene`.
  Geometry(std::shared_ptr<const scene::Scene> scene, std::shared_ptr<const scene::Shape> shape);

  std::shared_ptr<const scene::Scene> scene;  ///< whose materials and textures the indices below mean
  std::shared_ptr<const scene::Weathering> weathering;  ///< what lies on its surfaces; null: nothing
  std::shared_ptr<const scene::Shape> shape;            ///< whose all that follows is

  image::ArrayView<Eigen::Vector3f> positions;
  image::ArrayView<Eigen::Vector3f> normals;
  image::ArrayView<Eigen::Vector2f> texture_coordinates;
  std::vector<image::ArrayView<Eigen::Vector2f>> more_texture_coordinates;
  image::ArrayView<Eigen::Vector4f> tangents;
  image::ArrayView<Eigen::Array3f> colors;
  image::ArrayView<std::array<std::uint32_t, 3>> triangles;
  image::ArrayView<scene::Plane> planes;
  image::ArrayView<std::int32_t> materials;
  image::ArrayView<scene::Chunk> chunks;

  /// Of a set of scene::TextureUse: one a vertex; null: no mesh has it.
  const image::ArrayView<Eigen::Vector2f>* coordinates(int set) const {
    if (set == 0) return &texture_coordinates;
    const auto more = static_cast<std::size_t>(set - 1);
    return more < more_texture_coordinates.size() ? &more_texture_coordinates[more] : nullptr;
  }
};

}  // namespace sunlit::light
