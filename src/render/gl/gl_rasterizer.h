/// OpenGL resolves edges and depth of triangles that are on the screen already.
#pragma once

#include "render/gl/device.h"
#include "render/gl/mask_table.h"
#include "render/gl/triangle_list.h"
#include "render/rasterizer.h"
#include "render/visible_triangles.h"

namespace sunlit::render::gl {

class Objects;

class GlRasterizer : public Rasterizer {
 public:
  /// Throws std::runtime_error if the scene's masks are more than the device can hold.
  GlRasterizer(std::shared_ptr<Device> device, const RasterizerWorld& world);
  ~GlRasterizer() override;

  void draw(const View& view, const light::Geometry* bodies, std::vector<Sample>* samples) override;
  std::string device() const override { return device_->renderer(); }

 private:
  /// A part of the picture that is drawn at once, in samples.
  struct Pass {
    int left, top, width, height;
  };

  void drawPass(const Functions& gl, const Pass& pass, float farthest) const;
  /// What the pass saw, into the picture.
  void write(const Pass& pass, const View& view, Sample* samples) const;

  std::shared_ptr<Device> device_;
  VisibleTriangles visible_;
  MaskTable masks_;
  float texels_factor_;  ///< 2^(2 · bias)
  TriangleList list_;
  std::vector<std::uint32_t> seen_;   ///< of a pass: index into list_ plus 1, or 0
  std::unique_ptr<Objects> objects_;  ///< of OpenGL; made and used on the device's thread
};

}  // namespace sunlit::render::gl
