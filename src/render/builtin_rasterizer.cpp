#include "render/builtin_rasterizer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/tile_raster.h"

namespace sunlit::render {

BuiltinRasterizer::BuiltinRasterizer(const RasterizerWorld& world)
    : visible_(world.geometry, world.pyramids),
      texels_factor_(static_cast<float>(std::exp2(2.0 * world.lod_bias))) {}

void BuiltinRasterizer::sortIntoTiles(const Grid& grid, const std::vector<ScreenTriangle>& triangles,
                                      TileLists* lists) {
  const auto tiles = static_cast<std::size_t>(grid.columns * grid.rows);
  const auto forEachTile = [&](const ScreenTriangle& triangle, auto visit) {
    for (int y = triangle.top / grid.tile_size; y <= triangle.bottom / grid.tile_size; ++y) {
      for (int x = triangle.left / grid.tile_size; x <= triangle.right / grid.tile_size; ++x)
        visit(static_cast<std::size_t>(y * grid.columns + x));
    }
  };
  lists->begin.assign(tiles + 1, 0);
  for (const ScreenTriangle& triangle : triangles)
    forEachTile(triangle, [&](std::size_t tile) { ++lists->begin[tile]; });
  std::uint32_t sum = 0;
  for (std::uint32_t& begin : lists->begin) sum += std::exchange(begin, sum);
  lists->of_tile.resize(sum);
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    forEachTile(triangles[i], [&](std::size_t tile) { lists->of_tile[lists->begin[tile]++] = i; });
  // Each beginning has moved on to the next one's.
  for (std::size_t tile = tiles; tile > 0; --tile) lists->begin[tile] = lists->begin[tile - 1];
  lists->begin[0] = 0;
}

void BuiltinRasterizer::draw(const View& view, const light::Geometry* bodies, std::vector<Sample>* samples) {
  const int width = view.camera.width * view.supersampling, height = view.camera.height * view.supersampling;
  samples->resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const int size = view.supersampling * light::Surfaces::kTileSize;
  const Grid grid{size, (width + size - 1) / size, (height + size - 1) / size};
  visible_.gather(view, bodies);
  lists_.resize(std::max(lists_.size(), visible_.groups()));
  visible_.project(view,
                   [&](std::size_t i) { sortIntoTiles(grid, visible_.group(i).triangles, &lists_[i]); });
  tbb::parallel_for(0, grid.columns * grid.rows, [&](int tile) {
    thread_local TileRaster raster;
    const int left = tile % grid.columns * size, top = tile / grid.columns * size;
    raster.start({left, top, std::min(left + size, width) - 1, std::min(top + size, height) - 1},
                 static_cast<float>(view.far_m));
    const auto t = static_cast<std::size_t>(tile);
    for (std::size_t g = 0; g < visible_.groups(); ++g) {
      const ScreenTriangles& group = visible_.group(g);
      const TileLists& lists = lists_[g];
      for (std::uint32_t i = lists.begin[t]; i < lists.begin[t + 1]; ++i)
        raster.draw(group.triangles[lists.of_tile[i]], group.masks, texels_factor_);
    }
    raster.write(static_cast<std::size_t>(width), samples->data());
  });
}

}  // namespace sunlit::render
