/// Our own rasterizer: whole-number edges, tile by tile, the same bits on every processor.
#pragma once

#include "render/rasterizer.h"
#include "render/visible_triangles.h"

namespace sunlit::render {

class BuiltinRasterizer : public Rasterizer {
 public:
  explicit BuiltinRasterizer(const RasterizerWorld& world);

  void draw(const View& view, const light::Geometry* bodies, std::vector<Sample>* samples) override;
  std::string device() const override { return {}; }

 private:
  struct Grid {
    int tile_size;  ///< samples
    int columns, rows;
  };
  /// Those of a group that may touch tile i: of_tile[begin[i]] to of_tile[begin[i + 1]], in order.
  struct TileLists {
    std::vector<std::uint32_t> begin, of_tile;
  };

  static void sortIntoTiles(const Grid& grid, const std::vector<ScreenTriangle>& triangles, TileLists* lists);

  VisibleTriangles visible_;
  float texels_factor_;           ///< 2^(2 · bias)
  std::vector<TileLists> lists_;  ///< one a group
};

}  // namespace sunlit::render
