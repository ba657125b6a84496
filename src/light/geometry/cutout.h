/// Where alpha-masked triangles are solid.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sunlit/light/geometry.h"
#include "sunlit/quantity/whole.h"

namespace sunlit::light {

/// Whether a material blends with the same alpha everywhere. Looks at all texels of its texture.
bool blendsEvenly(const scene::Scene& scene, const scene::Material& material);

/// Sorts a scene's triangles into opaque and masked ones, and answers for the latter by their texture's full
/// resolution, bilinearly filtered as in the image. What blends is masked too: solid at a share of its points
/// that is its alpha there, chosen by a hash of triangle and point, so that of n rays a share of alpha ±
/// √(alpha (1 − alpha) / n) is stopped, always the same.
class Cutouts {
  struct Triangle;
  struct Mask;

 public:
  /// What becomes of glass and of what blends.
  enum class Veils {
    kByChance,  ///< masked; glass stops so many rays as it keeps light back, on average over a half sphere:
                ///< by their angle see Query::share()
    kLeftOut,   ///< glass and what blends evenly are in neither list
    kEvenOnly,  ///< what blends evenly is masked, and nothing else is in either list
  };
  explicit Cutouts(const Geometry& geometry, Veils veils = Veils::kByChance);

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
    Query(const Cutouts& cutouts, std::uint32_t masked_triangle)
        : triangle_(cutouts.triangles_[masked_triangle]),
          mask_(cutouts.masks_[static_cast<std::size_t>(triangle_.mask)]),
          number_(masked_triangle) {}
    bool solid(float u, float v) const;
    /// The same of `count` points: 1 or 0.
    void solid(const float* u, const float* v, std::size_t count, std::uint8_t* solid) const;
    /// Of what blends: the share of light that stops there, which meets it by this cosine to its normal;
    /// glass asks for that.
    float share(float u, float v, float cosine) const;
    /// Colour of what comes through of white light, of luminance 1.
    const Eigen::Array3f& tint() const { return mask_.tint; }
    /// Whether such a share means this point: up to a hash of it and of the triangle, for of sheets that
    /// cover one another each stops rays by itself.
    bool isThere(float share, float u, float v) const;

    /// Whether it lets a share of light through, rather than having holes.
    bool blends() const { return mask_.blended != Mask::kCutOut; }

   private:
    float alpha(float u, float v) const;
    /// Between which texels a point lies, and how far from the first ones.
    struct Place {
      int x0, y0;
      float fx, fy;
    };
    Place placeOf(float u, float v) const;

    const Triangle& triangle_;
    const Mask& mask_;
    std::uint32_t number_;
  };

 private:
  /// The texture on a triangle, in texels from the centre of the top left one.
  struct Triangle {
    Eigen::Vector2f origin, along_u, along_v;
    std::int32_t mask;  ///< index into masks_
    bool repeats;       ///< it goes beyond the texture's edge
  };
  /// A texture's alpha with one cutoff. Most queries fall between four texels that are all solid or all
  /// clear: two bits for each such square answer them, in far less memory than the texels, which would not
  /// stay in a core's cache.
  struct Mask {
    Mask(const scene::Texture& source, float alpha_cutoff);
    static constexpr float kCutOut = -1.0f;
    float blended = kCutOut;  ///< factor on alpha; kCutOut: solid where alpha reaches the cutoff
    /// Of glass: luminance that comes through, by steps of the cosine from 0 to 1; else empty.
    std::vector<float> through;
    Eigen::Array3f tint = Eigen::Array3f::Ones();  ///< see Query::tint()

    enum Square : unsigned { kClear = 0, kSolid = 1, kMixed = 2 };
    /// Where the square stands whose top left corner is the centre of texel (x, y).
    std::size_t word(int x, int y) const {
      return static_cast<std::size_t>(((y >> 4) * blocks_a_row + (x >> 4)) * 16 + (y & 15));
    }
    unsigned square(int x, int y) const { return squares[word(x, y)] >> (2 * (x & 15)) & 3u; }
    float interpolated(int x0, int y0, float fx, float fy) const;
    Triangle place(const std::array<Eigen::Vector2f, 3>& texture_coordinates) const;

    const scene::Texture* texture;  ///< only to tell masks apart
    int width, height;
    float cutoff;  ///< of alpha, 0 … 255
    std::vector<std::uint8_t> alpha;
    /// Blocks of 16 × 16 squares, one word a row of a block, so that neighbours share a cache line.
    std::vector<std::uint32_t> squares;
    int blocks_a_row;
  };
  /// Index into masks_.
  std::int32_t maskOf(const scene::Texture& texture, float alpha_cutoff, float blended);
  std::int32_t maskOfGlass(const scene::Material& material);

  std::vector<std::uint32_t> opaque_, masked_;
  std::vector<Triangle> triangles_;  ///< parallel to masked_
  std::vector<Mask> masks_;          ///< one a texture and cutoff
};

// Inlined: asked for every ray that meets a card.
inline Cutouts::Query::Place Cutouts::Query::placeOf(float u, float v) const {
  float x = triangle_.origin.x() + u * triangle_.along_u.x() + v * triangle_.along_v.x();
  float y = triangle_.origin.y() + u * triangle_.along_u.y() + v * triangle_.along_v.y();
  if (triangle_.repeats) {
    x -= static_cast<float>(mask_.width * floorOf((x + 0.5f) / static_cast<float>(mask_.width)));
    y -= static_cast<float>(mask_.height * floorOf((y + 0.5f) / static_cast<float>(mask_.height)));
  }
  const int left = floorOf(x), above = floorOf(y);
  // Rounding may take a point on the texture's edge beyond it.
  return {left < 0 ? mask_.width - 1 : std::min(left, mask_.width - 1),
          above < 0 ? mask_.height - 1 : std::min(above, mask_.height - 1), x - static_cast<float>(left),
          y - static_cast<float>(above)};
}

inline bool Cutouts::Query::solid(float u, float v) const {
  if (blends()) return isThere(alpha(u, v), u, v);
  const Place at = placeOf(u, v);
  const unsigned square = mask_.square(at.x0, at.y0);
  if (square != Mask::kMixed) return square == Mask::kSolid;
  return mask_.interpolated(at.x0, at.y0, at.fx, at.fy) >= mask_.cutoff;
}

}  // namespace sunlit::light
