#include "render/gl/triangle_list.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace sunlit::render::gl {
namespace {

TriangleList::Masked maskedOf(const ScreenTriangle& triangle, const MaskPlanes& planes, std::int32_t mask) {
  // From a sample that the triangle may cover: far from it its planes may be anywhere, and digits get lost.
  const int column = triangle.left, row = triangle.top;
  const auto at = [&](const Linear& linear) { return static_cast<float>(linear(column, row)); };
  const auto across = [](const Linear& linear) { return static_cast<float>(linear.per_column); };
  const auto downwards = [](const Linear& linear) { return static_cast<float>(linear.per_row); };
  const Linear &w = triangle.nearness, &u = planes.u_per_depth, &v = planes.v_per_depth;
  return {at(w),
          across(w),
          downwards(w),
          mask,  //
          at(u),
          across(u),
          downwards(u),
          planes.u_eye,  //
          at(v),
          across(v),
          downwards(v),
          planes.v_eye,  //
          triangle.nearness_least,
          triangle.nearness_greatest,
          static_cast<float>(column),
          static_cast<float>(row)};
}

}  // namespace

void TriangleList::assemble(const VisibleTriangles& visible, const MaskTable& masks, float near_m) {
  std::vector<Places> places(visible.groups() + 1, Places{0, 0});
  for (std::size_t g = 0; g < visible.groups(); ++g) {
    const std::vector<ScreenTriangle>& triangles = visible.group(g).triangles;
    const auto opaque = static_cast<std::size_t>(
        std::count_if(triangles.begin(), triangles.end(),
                      [](const ScreenTriangle& t) { return t.mask == ScreenTriangle::kNoMask; }));
    places[g + 1] = {places[g].opaque + opaque, places[g].masked + triangles.size() - opaque};
  }
  const Places all = places.back();
  triangles_.resize(all.opaque + all.masked);
  corners_.resize(3 * triangles_.size());
  masked_.resize(all.masked);
  tbb::parallel_for(std::size_t{0}, visible.groups(),
                    [&](std::size_t g) { place(visible.group(g), places[g], masks, near_m); });
}

void TriangleList::place(const ScreenTriangles& group, Places at, const MaskTable& masks, float near_m) {
  for (const ScreenTriangle& triangle : group.triangles) {
    std::size_t index = at.opaque;
    if (triangle.mask == ScreenTriangle::kNoMask) {
      ++at.opaque;
    } else {
      const MaskPlanes& planes = group.masks[static_cast<std::size_t>(triangle.mask)];
      masked_[at.masked] = maskedOf(triangle, planes, masks.first_row.at(planes.texture));
      index = opaque() + at.masked++;
    }
    triangles_[index] = &triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      constexpr double kSample = 1.0 / ScreenTriangle::kSteps;
      const auto nearness =
          static_cast<float>(triangle.nearness(triangle.x[i] * kSample, triangle.y[i] * kSample));
      corners_[3 * index + i] = {
          triangle.x[i], triangle.y[i],
          near_m * std::clamp(nearness, triangle.nearness_least, triangle.nearness_greatest)};
    }
  }
}

}  // namespace sunlit::render::gl
