#include "render/gl/triangle_list.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "render/gl/mask_sizes.h"

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

/// Samples of a box that are sooner looked at one by one than drawn in vain.
constexpr int kSmall = 16;

/// Whether a small triangle covers a sample, by the rule of TileRaster; true of all others.
bool mayCoverASample(const ScreenTriangle& t) {
  if ((t.right - t.left + 1) * (t.bottom - t.top + 1) > kSmall) return true;
  constexpr std::int64_t kSteps = ScreenTriangle::kSteps;
  for (int row = t.top; row <= t.bottom; ++row) {
    for (int column = t.left; column <= t.right; ++column) {
      bool inside = true;
      for (std::size_t from = 0; from < 3; ++from) {
        const std::size_t to = from == 2 ? 0 : from + 1;
        const std::int64_t along = t.x[to] - t.x[from], down = t.y[to] - t.y[from];
        const std::int64_t side = along * (kSteps * row - t.y[from]) - down * (kSteps * column - t.x[from]);
        const bool owned = down < 0 || (down == 0 && along > 0);
        inside &= owned ? side >= 0 : side > 0;
      }
      if (inside) return true;
    }
  }
  return false;
}

}  // namespace

TriangleList::Decision TriangleList::decide(const ScreenTriangle& triangle,
                                            const ScreenTriangles& group) const {
  if (!mayCoverASample(triangle)) return {kBatches, 0};
  if (triangle.mask == ScreenTriangle::kNoMask) return {kOpaque, 0};
  const MaskPlanes& planes = group.masks[static_cast<std::size_t>(triangle.mask)];
  const std::int32_t mask = masks_.first_row.at(planes.texture), full = mask + 1;
  const MaskSizes sizes = maskSizesOf(triangle, planes, texels_factor_);
  if (sizes.smallest == 0) return {kFullSize, full};
  const auto last = static_cast<int>(planes.texture->sizes()) - 1;
  const int largest = std::min(sizes.largest, last), smallest = std::min(sizes.smallest, last);
  if (largest == 0 || largest != smallest) return {kAnySize, mask};
  return {kOneSmallerSize, full + largest};
}

void TriangleList::assemble(const VisibleTriangles& visible, float near_m) {
  const std::size_t groups = visible.groups();
  decisions_.resize(std::max(decisions_.size(), groups));
  std::vector<Places> counts(groups, Places{});
  tbb::parallel_for(std::size_t{0}, groups, [&](std::size_t g) {
    const ScreenTriangles& group = visible.group(g);
    decisions_[g].clear();
    for (const ScreenTriangle& triangle : group.triangles) {
      const Decision decision = decide(triangle, group);
      decisions_[g].push_back(decision);
      if (decision.batch != kBatches) ++counts[g][decision.batch];
    }
  });
  std::size_t sum = 0;
  for (std::size_t batch = 0; batch < kBatches; ++batch) {
    begin_[batch] = sum;
    for (Places& places : counts) sum += std::exchange(places[batch], sum);
  }
  begin_[kBatches] = sum;
  triangles_.resize(sum);
  corners_.resize(3 * sum);
  masked_.resize(sum - count(kOpaque));
  tbb::parallel_for(std::size_t{0}, groups,
                    [&](std::size_t g) { place(visible.group(g), decisions_[g], counts[g], near_m); });
}

void TriangleList::place(const ScreenTriangles& group, const std::vector<Decision>& decisions, Places at,
                         float near_m) {
  for (std::size_t t = 0; t < group.triangles.size(); ++t) {
    const Decision& decision = decisions[t];
    if (decision.batch == kBatches) continue;
    const ScreenTriangle& triangle = group.triangles[t];
    const std::size_t index = at[decision.batch]++;
    if (decision.batch != kOpaque) {
      const MaskPlanes& planes = group.masks[static_cast<std::size_t>(triangle.mask)];
      masked_[index - count(kOpaque)] = maskedOf(triangle, planes, decision.mask);
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
