/// Which triangle each sample of a picture sees.
#pragma once

#include <memory>
#include <vector>

#include "render/sample.h"
#include "render/screen_triangle.h"
#include "render/texture_pyramid.h"
#include "render/view.h"
#include "sunlit/light/geometry.h"
#include "sunlit/light/surfaces.h"

namespace sunlit::render {

class Rasteriser {
 public:
  /// Keeps a reference to `pyramids`, of the geometry's scene. `lod_bias` in levels.
  Rasteriser(std::shared_ptr<const light::Geometry> geometry, const TexturePyramids& pyramids,
             double lod_bias);

  /// Fills `samples`, row-major, top row first: supersampling² a pixel. Triangles of `bodies`, which may be
  /// null, are numbered after those of the geometry, whose materials they share. Parallel; the same bits for
  /// any number of threads.
  void draw(const View& view, const light::Geometry* bodies, std::vector<Sample>* samples);

 private:
  /// Consecutive triangles of one material.
  struct Piece {
    const light::Geometry* geometry;
    std::uint32_t first, count, first_number;
    int material;
  };
  /// Some pieces: the unit of parallel projection.
  struct Group {
    std::vector<Piece> pieces;
    ScreenTriangles projected;
    /// Those that may touch tile i: of_tile[tile_begin[i]] to of_tile[tile_begin[i + 1]], in order.
    std::vector<std::uint32_t> tile_begin, of_tile;
  };
  struct Grid {
    int tile_size;  ///< samples
    int columns, rows;
  };

  void addVisible(const View& view, const light::Geometry& geometry, std::uint32_t first_number);
  void project(const ScreenProjection& projection, const Grid& grid, Group* group) const;
  static void sortIntoTiles(const Grid& grid, Group* group);

  std::shared_ptr<const light::Geometry> geometry_;
  const TexturePyramids& pyramids_;
  float texels_factor_;  ///< 2^(2 · bias)
  std::vector<Group> groups_;
  std::size_t groups_in_use_ = 0;
};

}  // namespace sunlit::render
