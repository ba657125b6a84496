#include "render/rasteriser.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/frustum.h"
#include "render/tile_raster.h"

namespace sunlit::render {
namespace {

/// Triangles that one task projects, about: enough to be worth a task, few enough for many tasks.
constexpr std::uint32_t kGroupSize = 2048;

}  // namespace

Rasteriser::Rasteriser(std::shared_ptr<const light::Geometry> geometry, const TexturePyramids& pyramids,
                       double lod_bias)
    : geometry_(std::move(geometry)),
      pyramids_(pyramids),
      texels_factor_(static_cast<float>(std::exp2(2.0 * lod_bias))) {}

void Rasteriser::addVisible(const View& view, const light::Geometry& geometry, std::uint32_t first_number) {
  const Frustum frustum(view);
  const Eigen::Vector3f eye = view.eye().cast<float>();
  std::vector<std::pair<float, const light::Chunk*>> near_first;
  for (const light::Chunk& chunk : geometry.chunks) {
    if (frustum.touches(chunk.box)) near_first.emplace_back(chunk.box.squaredExteriorDistance(eye), &chunk);
  }
  // What is near hides what is far, before its samples are looked at.
  std::stable_sort(near_first.begin(), near_first.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::uint32_t room = 0;
  for (const auto& [distance, chunk] : near_first) {
    for (std::uint32_t done = 0; done < chunk->count;) {
      if (room == 0) {
        if (groups_.size() == groups_in_use_) groups_.emplace_back();
        groups_[groups_in_use_++].pieces.clear();
        room = kGroupSize;
      }
      const std::uint32_t count = std::min(room, chunk->count - done);
      groups_[groups_in_use_ - 1].pieces.push_back(
          {&geometry, chunk->first + done, count, first_number, chunk->material});
      done += count;
      room -= count;
    }
  }
}

void Rasteriser::project(const ScreenProjection& projection, const Grid& grid, Group* group) const {
  group->projected.clear();
  for (const Piece& piece : group->pieces) {
    const scene::Material& material = geometry_->scene->materials[static_cast<std::size_t>(piece.material)];
    projection.append({*piece.geometry, piece.first, piece.count, material, piece.first_number,
                       pyramids_.of(piece.material)},
                      &group->projected);
  }
  sortIntoTiles(grid, group);
}

void Rasteriser::sortIntoTiles(const Grid& grid, Group* group) {
  const auto tiles = static_cast<std::size_t>(grid.columns * grid.rows);
  const auto forEachTile = [&](const ScreenTriangle& triangle, auto visit) {
    for (int y = triangle.top / grid.tile_size; y <= triangle.bottom / grid.tile_size; ++y) {
      for (int x = triangle.left / grid.tile_size; x <= triangle.right / grid.tile_size; ++x)
        visit(static_cast<std::size_t>(y * grid.columns + x));
    }
  };
  const std::vector<ScreenTriangle>& triangles = group->projected.triangles;
  group->tile_begin.assign(tiles + 1, 0);
  for (const ScreenTriangle& triangle : triangles)
    forEachTile(triangle, [&](std::size_t tile) { ++group->tile_begin[tile]; });
  std::uint32_t sum = 0;
  for (std::uint32_t& begin : group->tile_begin) sum += std::exchange(begin, sum);
  group->of_tile.resize(sum);
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    forEachTile(triangles[i], [&](std::size_t tile) { group->of_tile[group->tile_begin[tile]++] = i; });
  // Each beginning has moved on to the next one's.
  for (std::size_t tile = tiles; tile > 0; --tile) group->tile_begin[tile] = group->tile_begin[tile - 1];
  group->tile_begin[0] = 0;
}

void Rasteriser::draw(const View& view, const light::Geometry* bodies, std::vector<Sample>* samples) {
  const int width = view.camera.width * view.supersampling, height = view.camera.height * view.supersampling;
  samples->resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  groups_in_use_ = 0;
  // Bodies first: a robot that carries the camera is near, and hides what is behind it.
  if (bodies) addVisible(view, *bodies, static_cast<std::uint32_t>(geometry_->triangles.size()));
  addVisible(view, *geometry_, 0);
  const int size = view.supersampling * light::Surfaces::kTileSize;
  const Grid grid{size, (width + size - 1) / size, (height + size - 1) / size};
  const ScreenProjection projection(view);
  tbb::parallel_for(std::size_t{0}, groups_in_use_,
                    [&](std::size_t i) { project(projection, grid, &groups_[i]); });
  tbb::parallel_for(0, grid.columns * grid.rows, [&](int tile) {
    thread_local TileRaster raster;
    const int left = tile % grid.columns * size, top = tile / grid.columns * size;
    raster.start({left, top, std::min(left + size, width) - 1, std::min(top + size, height) - 1},
                 static_cast<float>(view.far_m));
    for (std::size_t g = 0; g < groups_in_use_; ++g) {
      const Group& group = groups_[g];
      const auto t = static_cast<std::size_t>(tile);
      for (std::uint32_t i = group.tile_begin[t]; i < group.tile_begin[t + 1]; ++i)
        raster.draw(group.projected.triangles[group.of_tile[i]], group.projected.masks, texels_factor_);
    }
    raster.write(static_cast<std::size_t>(width), samples->data());
  });
}

}  // namespace sunlit::render
