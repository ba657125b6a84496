/// Draws a scene's geometry into samples that C++ lights.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "render/frustum.h"
#include "render/gl_program.h"
#include "render/packed_sample.h"
#include "render/textures.h"
#include "render/view.h"
#include "sunlit/light/geometry.h"

namespace sunlit::render {

/// A GL context must be current at construction, draw() and destruction.
class GeometryPass {
 public:
  /// `view` gives the size of the picture; its pose is not used.
  GeometryPass(std::shared_ptr<const light::Geometry> geometry, const View& view, double lod_bias);
  ~GeometryPass();
  GeometryPass(const GeometryPass&) = delete;
  GeometryPass& operator=(const GeometryPass&) = delete;

  /// Fills `samples`, row-major, top row first: supersampling² a pixel.
  void draw(const View& view, std::vector<PackedSample>* samples);

 private:
  struct Variant;
  void uploadVertices();
  void createTarget(const View& view);
  std::vector<const light::Chunk*> visibleChunks(const View& view) const;
  const Variant& variant(const scene::Material& material);
  void setView(const Variant& variant, const View& view) const;
  void setMaterial(const Variant& variant, const scene::Material& material) const;

  std::shared_ptr<const light::Geometry> geometry_;
  Textures textures_;
  PFNGLCLIPCONTROLPROC clip_control_;
  std::map<int, std::unique_ptr<Variant>> variants_;
  GLuint vertex_array_ = 0, vertices_ = 0, indices_ = 0;
  GLuint framebuffer_ = 0, color_ = 0, depth_ = 0;
};

}  // namespace sunlit::render
