/// The triangles of a picture in the form that shaders take them: the opaque ones first, then the masked.
#pragma once

#include <cstdint>
#include <vector>

#include "render/gl/mask_table.h"
#include "render/visible_triangles.h"

namespace sunlit::render::gl {

class TriangleList {
 public:
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

  /// Of all groups, which must stay as they are while this is used. Parallel.
  void assemble(const VisibleTriangles& visible, const MaskTable& masks, float near_m);

  const std::vector<Corner>& corners() const { return corners_; }  ///< three a triangle
  const std::vector<Masked>& masked() const { return masked_; }
  std::size_t size() const { return triangles_.size(); }
  std::size_t opaque() const { return triangles_.size() - masked_.size(); }
  const ScreenTriangle& operator[](std::size_t i) const { return *triangles_[i]; }

 private:
  /// Where the triangles of a group go.
  struct Places {
    std::size_t opaque, masked;
  };
  void place(const ScreenTriangles& group, Places at, const MaskTable& masks, float near_m);

  std::vector<Corner> corners_;
  std::vector<Masked> masked_;
  std::vector<const ScreenTriangle*> triangles_;
};

}  // namespace sunlit::render::gl
