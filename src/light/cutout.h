/// Where alpha-masked triangles are solid.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sunlit/light/geometry.h"

namespace sunlit::light {

/// Sorts a scene's triangles into opaque and masked ones, and answers for the latter by their texture's full
/// resolution, bilinearly filtered as in the image.
class Cutouts {
 public:
  explicit Cutouts(const Geometry& geometry);

  /// Indices into Geometry::triangles.
  const std::vector<std::uint32_t>& opaqueTriangles() const { return opaque_; }
  const std::vector<std::uint32_t>& maskedTriangles() const { return masked_; }
  /// Whether light stops at barycentric (u, v) of the masked triangle with this index into maskedTriangles().
  bool solid(std::uint32_t masked_triangle, float u, float v) const;

 private:
  struct Triangle {
    std::array<Eigen::Vector2f, 3> texture_coordinates;
    std::int32_t texture;
    float cutoff;  ///< of alpha, 0 … 255
  };
  struct AlphaPlane {
    int width = 0, height = 0;
    std::vector<std::uint8_t> alpha;
  };
  std::vector<std::uint32_t> opaque_, masked_;
  std::vector<Triangle> triangles_;  ///< parallel to masked_
  std::vector<AlphaPlane> planes_;   ///< one a texture of the scene; empty where no mask uses it
};

}  // namespace sunlit::light
