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
  struct Mask;

 public:
  explicit Cutouts(const Geometry& geometry);

  /// Indices into Geometry::triangles.
  const std::vector<std::uint32_t>& opaqueTriangles() const { return opaque_; }
  const std::vector<std::uint32_t>& maskedTriangles() const { return masked_; }
  /// Whether light stops at barycentric (u, v) of the masked triangle with this index into maskedTriangles().
  bool solid(std::uint32_t masked_triangle, float u, float v) const {
    return Query(*this, masked_triangle).solid(u, v);
  }
  /// The same of one triangle, for many points.
  class Query {
   public:
    Query(const Cutouts& cutouts, std::uint32_t masked_triangle);
    bool solid(float u, float v) const;

   private:
    const Mask& mask_;
    Eigen::Vector2f origin_, along_u_, along_v_;  ///< in widths and heights of the texture
  };

 private:
  struct Triangle {
    std::array<Eigen::Vector2f, 3> texture_coordinates;
    std::int32_t mask;  ///< index into masks_
  };
  /// A texture's alpha with one cutoff. Most queries fall between four texels that are all solid or all
  /// clear: two bits for each such square answer them, in far less memory than the texels, which would not
  /// stay in a core's cache.
  struct Mask {
    Mask(const scene::Texture& source, float alpha_cutoff);

    enum Square : unsigned { kClear = 0, kSolid = 1, kMixed = 2 };
    /// Of the square whose top left corner is the centre of texel (x, y).
    unsigned square(int x, int y) const;
    float interpolated(int x0, int y0, float fx, float fy) const;

    const scene::Texture* texture;  ///< only to tell masks apart
    int width, height;
    float cutoff;  ///< of alpha, 0 … 255
    std::vector<std::uint8_t> alpha;
    /// Blocks of 16 × 16 squares, one word a row of a block, so that neighbours share a cache line.
    std::vector<std::uint32_t> squares;
    int blocks_a_row;
  };
  std::vector<std::uint32_t> opaque_, masked_;
  std::vector<Triangle> triangles_;  ///< parallel to masked_
  std::vector<Mask> masks_;          ///< one a texture and cutoff
};

}  // namespace sunlit::light
