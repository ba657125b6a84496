/// A point of a path of light, where it meets a surface.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "light/shading/shading.h"
#include "sunlit/light/geometry.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {

struct Vertex {
  Reflection reflection;
  Eigen::Vector3f geometric_normal;  ///< unit, on the side of the eye
  Eigen::Vector3f front, behind;     ///< where rays on either side start, m in `map`
  Eigen::Array3f emission;           ///< luminance of its own, cd/m²
  float film = 0.0f;                 ///< Surface::film
  const scene::Material* material;

  /// Whether light can come from `towards` at all, as far as this surface itself is concerned.
  bool faces(const Eigen::Vector3f& towards) const {
    return reflection.transmission > 0.0f || geometric_normal.dot(towards) > 0.0f;
  }
  const Eigen::Vector3f& origin(const Eigen::Vector3f& towards) const {
    return geometric_normal.dot(towards) > 0.0f ? front : behind;
  }
};

/// Surface of the picture, seen by its sample number `sample`.
Vertex seenVertex(const Tile& tile, const Surface& surface, const scene::Scene& scene, std::uint32_t sample);

/// What bounced light meets.
class SceneVertices {
 public:
  /// Keeps references. `bodies`: what moves, its triangles numbered after those of `geometry`; or null.
  explicit SceneVertices(const Geometry& geometry, const Geometry* bodies = nullptr);

  const scene::Material& material(const Hit& hit) const;

  /// Where a ray that came along unit vector `direction` ends.
  Vertex at(const Hit& hit, const Eigen::Vector3f& direction) const;

 private:
  enum class TexelKind { kColor, kData };
  /// A point of a triangle of one of the two.
  struct Point {
    const Geometry& geometry;
    Hit hit;
  };
  Point pointOf(const Hit& hit) const;
  /// Linear, between the texels of the full size.
  std::optional<Eigen::Array3f> texel(const Point& point, const scene::TextureUse& use, TexelKind kind) const;
  Eigen::Array3f albedo(const Point& point, const scene::Material& material) const;
  float roughness(const Point& point, const scene::Material& material) const;
  float metalness(const Point& point, const scene::Material& material) const;
  static void weather(const Geometry& geometry, const Eigen::Vector3f& position, Vertex* vertex);

  const Geometry& geometry_;
  const Geometry* bodies_;
};

}  // namespace sunlit::light
