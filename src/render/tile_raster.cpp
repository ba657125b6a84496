#include "render/tile_raster.h"

#include <algorithm>
#include <limits>

namespace sunlit::render {
namespace {

int floorOf(double value) {
  const int truncated = static_cast<int>(value);
  return truncated - (value < static_cast<double>(truncated) ? 1 : 0);
}

}  // namespace

/// Where a row crosses an edge, and on which side of there the triangle lies.
struct TileRaster::Edge {
  enum Side { kLeft, kRight, kAllOrNothing } inside;
  double per_row, constant;  ///< the column of the crossing; or, of a level edge, what is negative outside

  /// In steps, a sample is inside where along · (row − y) − down · (column − x) ≥ 0, and all of these are
  /// whole numbers. On the edge it belongs to one of the two triangles beside it. With half a unit on top no
  /// sample lies on the edge, and all are far enough from it for rounding in double precision to decide
  /// nothing: products stay below 2^50.
  Edge(const ScreenTriangle& triangle, std::size_t from) {
    const std::size_t to = (from + 1) % 3;
    const double x = triangle.x[from], y = triangle.y[from];
    const double along = triangle.x[to] - x, down = triangle.y[to] - y;
    const bool owned = down < 0.0 || (down == 0.0 && along > 0.0);
    const double offset = down * x - along * y + (owned ? 0.5 : -0.5);
    const double scale = down == 0.0 ? 1.0 : 1.0 / (down * ScreenTriangle::kSteps);
    inside = down == 0.0 ? kAllOrNothing : down > 0.0 ? kLeft : kRight;
    per_row = along * ScreenTriangle::kSteps * scale;
    constant = offset * scale;
  }

  double at(int row) const { return per_row * row + constant; }
};

void TileRaster::start(const Place& place, float far_m) {
  place_ = place;
  farthest_ = 1.0f / far_m;
  drawn_since_update_ = 0;
  for (int row = place.top; row <= place.bottom; ++row) {
    std::fill_n(&nearness_[index(place.left, row)], place.right - place.left + 1, farthest_);
    std::fill_n(&number_[index(place.left, row)], place.right - place.left + 1, 0u);
  }
}

void TileRaster::updateFarthest() {
  constexpr int kInterval = 32;
  if (++drawn_since_update_ < kInterval) return;
  drawn_since_update_ = 0;
  farthest_ = std::numeric_limits<float>::infinity();
  for (int row = place_.top; row <= place_.bottom; ++row) {
    const float* const begin = &nearness_[index(place_.left, row)];
    for (int i = 0; i <= place_.right - place_.left; ++i)
      farthest_ = begin[i] < farthest_ ? begin[i] : farthest_;
  }
}

void TileRaster::draw(const ScreenTriangle& triangle, const std::vector<MaskPlanes>& masks,
                      float texels_factor) {
  if (triangle.nearness_greatest <= farthest_) return;
  updateFarthest();
  const std::array<Edge, 3> edges = {Edge(triangle, 0), Edge(triangle, 1), Edge(triangle, 2)};
  const int left = std::max(triangle.left, place_.left), right = std::min(triangle.right, place_.right);
  const int bottom = std::min(triangle.bottom, place_.bottom);
  for (int row = std::max(triangle.top, place_.top); row <= bottom; ++row) {
    double before = left - 1, last = right;  // the span begins after the one and ends at or before the other
    for (const Edge& edge : edges) {
      const double at = edge.at(row);
      if (edge.inside == Edge::kLeft) {
        last = std::min(last, at);
      } else if (edge.inside == Edge::kRight) {
        before = std::max(before, at);
      } else if (at < 0.0) {
        last = before;
      }
    }
    if (!(before < last)) continue;
    const Span span{row, floorOf(before) + 1, floorOf(last)};
    if (span.left > span.right) continue;
    if (triangle.mask == ScreenTriangle::kNoMask) {
      fill(triangle, span);
    } else {
      fillMasked(triangle, span, masks[static_cast<std::size_t>(triangle.mask)], texels_factor);
    }
  }
}

void TileRaster::fill(const ScreenTriangle& triangle, const Span& span) {
  const auto first = static_cast<float>(triangle.nearness(span.left, span.row));
  const auto step = static_cast<float>(triangle.nearness.per_column);
  const float least = triangle.nearness_least, greatest = triangle.nearness_greatest;
  const std::uint32_t number = triangle.number;
  float* const nearness = &nearness_[index(span.left, span.row)];
  std::uint32_t* const numbers = &number_[index(span.left, span.row)];
  const int count = span.right - span.left + 1;
  for (int i = 0; i < count; ++i) {
    float here = first + step * static_cast<float>(i);
    here = here > least ? here : least;
    here = here < greatest ? here : greatest;
    const bool nearer = here > nearness[i];
    nearness[i] = nearer ? here : nearness[i];
    numbers[i] = nearer ? number : numbers[i];
  }
}

void TileRaster::fillMasked(const ScreenTriangle& triangle, const Span& span, const MaskPlanes& mask,
                            float texels_factor) {
  const auto value = [&](const Linear& linear) { return static_cast<float>(linear(span.left, span.row)); };
  const auto across = [](const Linear& linear) { return static_cast<float>(linear.per_column); };
  const auto downwards = [](const Linear& linear) { return static_cast<float>(linear.per_row); };
  const float w = value(triangle.nearness), w_x = across(triangle.nearness),
              w_y = downwards(triangle.nearness);
  const float u = value(mask.u_per_depth), u_x = across(mask.u_per_depth), u_y = downwards(mask.u_per_depth);
  const float v = value(mask.v_per_depth), v_x = across(mask.v_per_depth), v_y = downwards(mask.v_per_depth);
  const float width = mask.texture->size().x(), height = mask.texture->size().y();
  float* const nearness = &nearness_[index(span.left, span.row)];
  std::uint32_t* const numbers = &number_[index(span.left, span.row)];
  for (int i = 0; i <= span.right - span.left; ++i) {
    const float here =
        std::clamp(w + w_x * static_cast<float>(i), triangle.nearness_least, triangle.nearness_greatest);
    if (here <= nearness[i]) continue;
    const float depth = 1.0f / here;
    const float u_here = depth * (u + u_x * static_cast<float>(i));
    const float v_here = depth * (v + v_x * static_cast<float>(i));
    // How many texels lie to the next sample right and down: the derivatives of quotients.
    const float factor_x = width * depth, factor_y = height * depth;
    const float right_u = factor_x * (u_x - u_here * w_x), right_v = factor_y * (v_x - v_here * w_x);
    const float down_u = factor_x * (u_y - u_here * w_y), down_v = factor_y * (v_y - v_here * w_y);
    const float texels =
        texels_factor * std::max(right_u * right_u + right_v * right_v, down_u * down_u + down_v * down_v);
    if (!mask.texture->solid(mask.u_eye + u_here, mask.v_eye + v_here, texels)) continue;
    nearness[i] = here;
    numbers[i] = triangle.number;
  }
}

void TileRaster::write(std::size_t stride, Sample* samples) const {
  for (int row = place_.top; row <= place_.bottom; ++row) {
    Sample* const out =
        samples + static_cast<std::size_t>(row) * stride + static_cast<std::size_t>(place_.left);
    const float* const nearness = &nearness_[index(place_.left, row)];
    const std::uint32_t* const numbers = &number_[index(place_.left, row)];
    for (int i = 0; i <= place_.right - place_.left; ++i) {
      out[i].triangle = numbers[i];
      out[i].depth = 1.0f / nearness[i];
    }
  }
}

}  // namespace sunlit::render
