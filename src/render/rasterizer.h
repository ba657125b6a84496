/// Which triangle each sample of a picture sees.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/sample.h"
#include "render/texture_pyramid.h"
#include "render/view.h"
#include "sunlit/light/geometry.h"
#include "sunlit/render/rasterizer_kind.h"

namespace sunlit::render {

class Rasterizer {
 public:
  virtual ~Rasterizer() = default;

  /// Fills `samples`, row-major, top row first: supersampling² a pixel. Triangles of `bodies`, which may be
  /// null, are numbered after those of the geometry, whose materials they share. The same bits from run to
  /// run and for any number of threads. One call at a time; others of the same kind may draw meanwhile.
  virtual void draw(const View& view, const light::Geometry* bodies, std::vector<Sample>* samples) = 0;

  /// What draws, such as GL_RENDERER; empty for our own.
  virtual std::string device() const = 0;
};

/// What a rasterizer draws from.
struct RasterizerWorld {
  std::shared_ptr<const light::Geometry> geometry;
  const TexturePyramids& pyramids;  ///< of the geometry's scene; outlives the rasterizer
  double lod_bias = 0.0;            ///< levels
};

/// Throws as requireStarts() does.
std::unique_ptr<Rasterizer> makeRasterizer(RasterizerKind kind, const RasterizerWorld& world);

}  // namespace sunlit::render
