#include "render/visible_triangles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "render/frustum.h"
#include "sunlit/light/visibility.h"

namespace sunlit::render {
namespace {

/// Triangles that one task projects, about: enough to be worth a task, few enough for many tasks.
constexpr std::uint32_t kGroupSize = 2048;

}  // namespace

void VisibleTriangles::addVisible(const View& view, const light::Geometry& geometry,
                                  std::uint32_t first_number) {
  const Frustum frustum(view);
  const Eigen::Vector3f eye = view.eye().cast<float>();
  std::vector<std::pair<float, const scene::Chunk*>> near_first;
  for (const scene::Chunk& chunk : geometry.chunks) {
    const auto material = static_cast<std::size_t>(chunk.material);
    const bool veils = light::seenThrough(geometry.scene->materials[material]);
    if (!veils && frustum.touches(chunk.box))
      near_first.emplace_back(chunk.box.squaredExteriorDistance(eye), &chunk);
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

void VisibleTriangles::gather(const View& view, const light::Geometry* bodies) {
  groups_in_use_ = 0;
  // Bodies first: a robot that carries the camera is near, and hides what is behind it.
  if (bodies) addVisible(view, *bodies, static_cast<std::uint32_t>(geometry_->triangles.size()));
  addVisible(view, *geometry_, 0);
}

void VisibleTriangles::project(const View& view, const std::function<void(std::size_t)>& done) {
  const ScreenProjection projection(view);
  tbb::parallel_for(std::size_t{0}, groups_in_use_, [&](std::size_t i) {
    groups_[i].projected.clear();
    for (const Piece& piece : groups_[i].pieces) {
      const scene::Material& material = geometry_->scene->materials[static_cast<std::size_t>(piece.material)];
      projection.append({*piece.geometry, piece.first, piece.count, material, piece.first_number,
                         pyramids_.of(piece.material)},
                        &groups_[i].projected);
    }
    done(i);
  });
}

}  // namespace sunlit::render
