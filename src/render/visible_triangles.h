/// What of a world a picture may show, on its way to any rasterizer.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "render/screen_triangle.h"
#include "render/texture_pyramid.h"
#include "render/view.h"
#include "sunlit/light/geometry.h"

namespace sunlit::render {

class VisibleTriangles {
 public:
  /// Keeps a reference to `pyramids`, of the geometry's scene.
  VisibleTriangles(std::shared_ptr<const light::Geometry> geometry, const TexturePyramids& pyramids)
      : geometry_(std::move(geometry)), pyramids_(pyramids) {}

  const TexturePyramids& pyramids() const { return pyramids_; }

  /// Gathers all chunks that `view` may see into groups of some thousand triangles: bodies first, then what
  /// is near. Triangles of `bodies`, which may be null, are numbered after those of the geometry, whose
  /// materials they share.
  void gather(const View& view, const light::Geometry* bodies);
  std::size_t groups() const { return groups_in_use_; }
  /// Puts them on the screen of `view`. Parallel, the same for any number of threads; `done` is called for
  /// each group, by the thread that projected it.
  void project(const View& view, const std::function<void(std::size_t)>& done);
  const ScreenTriangles& group(std::size_t i) const { return groups_[i].projected; }

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
  };

  void addVisible(const View& view, const light::Geometry& geometry, std::uint32_t first_number);

  std::shared_ptr<const light::Geometry> geometry_;
  const TexturePyramids& pyramids_;
  std::vector<Group> groups_;  ///< keep their memory from picture to picture
  std::size_t groups_in_use_ = 0;
};

}  // namespace sunlit::render
