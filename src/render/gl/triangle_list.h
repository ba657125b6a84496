/// The triangles of a picture in the form that shaders take them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/gl/mask_table.h"
#include "render/visible_triangles.h"

namespace sunlit::render::gl {

class TriangleList {
 public:
  /// What is drawn at once, by one shader, in this order: what is solid hides before what is cut out is
  /// looked up, and so does what is near.
  enum Batch : std::uint8_t { kOpaque, kFullSize, kAnySize, kOneSmallerSize, kBatches };

  struct Corner {
    std::int32_t x, y;  ///< steps
    float depth;        ///< nearness times the nearest depth, 0 … 1
  };
  /// See kMaskedShader.
  struct Masked {
    float w, w_x, w_y;
    std::int32_t mask;
    float u, u_x, u_y, u_eye;
    float v, v_x, v_y, v_eye;
    float least, greatest, column, row;
  };

  /// `texels_factor`: 2^(2 · bias). Keeps a reference to `masks`.
  TriangleList(const MaskTable& masks, float texels_factor) : masks_(masks), texels_factor_(texels_factor) {}

  /// Of all groups, which must stay as they are while this is used; but for what covers no sample. Parallel.
  void assemble(const VisibleTriangles& visible, float near_m);

  const std::vector<Corner>& corners() const { return corners_; }  ///< three a triangle
  const std::vector<Masked>& masked() const { return masked_; }    ///< of all that are not in kOpaque
  std::size_t first(Batch batch) const { return begin_[batch]; }
  std::size_t count(Batch batch) const { return begin_[batch + 1] - begin_[batch]; }
  const ScreenTriangle& operator[](std::size_t i) const { return *triangles_[i]; }

 private:
  using Places = std::array<std::size_t, kBatches>;
  /// What becomes of a triangle.
  struct Decision {
    Batch batch;  ///< kBatches: it covers no sample
    std::int32_t mask;
  };
  Decision decide(const ScreenTriangle& triangle, const ScreenTriangles& group) const;
  /// Puts the triangles of a group where those of each batch begin.
  void place(const ScreenTriangles& group, const std::vector<Decision>& decisions, Places at, float near_m);

  const MaskTable& masks_;
  const float texels_factor_;
  std::vector<std::vector<Decision>> decisions_;  ///< by group
  std::vector<Corner> corners_;
  std::vector<Masked> masked_;
  std::vector<const ScreenTriangle*> triangles_;
  std::array<std::size_t, kBatches + 1> begin_{};
};

}  // namespace sunlit::render::gl
