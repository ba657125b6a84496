#include "render/tile_raster.h"

#include <algorithm>
#include <limits>

#include "sunlit/quantity/whole.h"

namespace sunlit::render {
namespace {

constexpr int kSmall = 32;  ///< samples of a box

}  // namespace

/// Where the rows of a triangle begin and end: after the greatest of three columns, and at or before the
/// least of three others. Each edge bounds one side and leaves the other to the rest; with no branch on
/// which, short rows cost little.
struct TileRaster::Edges {
  std::array<double, 3> after_per_row, after, until_per_row, until;
  int top, bottom;

  /// In steps, a sample is inside where along · (row − y) − down · (column − x) ≥ 0, and all of these are
  /// whole numbers. On the edge it belongs to one of the two triangles beside it. With half a unit on top no
  /// sample lies on the edge, and all are far enough from it for rounding in double precision to decide
  /// nothing: products stay below 2^50.
  Edges(const ScreenTriangle& triangle, int first_row, int last_row) : top(first_row), bottom(last_row) {
    constexpr double kFar = 1e9;  // columns
    for (std::size_t from = 0; from < 3; ++from) {
      const std::size_t to = from == 2 ? 0 : from + 1;
      const double x = triangle.x[from], y = triangle.y[from];
      const double along = triangle.x[to] - x, down = triangle.y[to] - y;
      const bool owned = down < 0.0 || (down == 0.0 && along > 0.0);
      const double offset = down * x - along * y + (owned ? 0.5 : -0.5);
      const double scale = 1.0 / (down * ScreenTriangle::kSteps);
      const double per_row = along * ScreenTriangle::kSteps * scale, constant = offset * scale;
      const bool ends = down > 0.0, begins = down < 0.0;
      after_per_row[from] = begins ? per_row : 0.0;
      after[from] = begins ? constant : -kFar;
      until_per_row[from] = ends ? per_row : 0.0;
      until[from] = ends ? constant : kFar;
      if (down == 0.0) cutLevel(along * ScreenTriangle::kSteps, offset);
    }
  }

  /// The first column of each row less one, and the last, within `left` to `right`; of all rows at once,
  /// which compilers turn into vector code.
  void spans(const Box& box, double* before, double* last) const {
    const double left = box.left - 1, right = box.right;
    for (int i = 0; i <= bottom - top; ++i) {
      const double row = top + i;
      const double a = after_per_row[0] * row + after[0], b = after_per_row[1] * row + after[1],
                   c = after_per_row[2] * row + after[2];
      const double d = until_per_row[0] * row + until[0], e = until_per_row[1] * row + until[1],
                   f = until_per_row[2] * row + until[2];
      const double ab = a > b ? a : b, cl = c > left ? c : left, de = d < e ? d : e,
                   fr = f < right ? f : right;
      before[i] = ab > cl ? ab : cl;
      last[i] = de < fr ? de : fr;
    }
  }

  /// Leaves only the rows on the inner side of a level edge.
  void cutLevel(double per_row, double constant) {
    while (top <= bottom && per_row * top + constant < 0.0) ++top;
    while (top <= bottom && per_row * bottom + constant < 0.0) --bottom;
  }
};

void TileRaster::start(const Place& place, float far_m) {
  place_ = place;
  farthest_.fill(1.0f / far_m);
  drawn_since_update_ = 0;
  for (int row = place.top; row <= place.bottom; ++row) {
    std::fill_n(&nearness_[index(place.left, row)], place.right - place.left + 1, 1.0f / far_m);
    std::fill_n(&number_[index(place.left, row)], place.right - place.left + 1, 0u);
  }
}

void TileRaster::updateFarthest() {
  constexpr int kInterval = 32;
  if (++drawn_since_update_ < kInterval) return;
  drawn_since_update_ = 0;
  farthest_.fill(std::numeric_limits<float>::infinity());
  for (int row = place_.top; row <= place_.bottom; ++row) {
    const float* const begin = &nearness_[index(place_.left, row)];
    float* const blocks = &farthest_[static_cast<std::size_t>((row - place_.top) / kBlock * kBlocks)];
    for (int i = 0; i <= place_.right - place_.left; ++i)
      blocks[i / kBlock] = begin[i] < blocks[i / kBlock] ? begin[i] : blocks[i / kBlock];
  }
}

/// Whether all that is in the box, if not more, is nearer than anything of a triangle.
bool TileRaster::hides(const Box& box, float nearness_greatest) const {
  const int left = (box.left - place_.left) / kBlock, right = (box.right - place_.left) / kBlock;
  const int top = (box.top - place_.top) / kBlock, bottom = (box.bottom - place_.top) / kBlock;
  bool nearer = false;
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x)
      nearer |= nearness_greatest > farthest_[static_cast<std::size_t>(y * kBlocks + x)];
  }
  if (!nearer) return true;
  // Of small triangles, as most are, the samples are sooner looked at than the edges found.
  if ((box.right - box.left + 1) * (box.bottom - box.top + 1) > kSmall) return false;
  nearer = false;
  for (int row = box.top; row <= box.bottom; ++row) {
    const float* const begin = &nearness_[index(box.left, row)];
    for (int i = 0; i <= box.right - box.left; ++i) nearer |= nearness_greatest > begin[i];
  }
  return !nearer;
}

void TileRaster::draw(const ScreenTriangle& triangle, const std::vector<MaskPlanes>& masks,
                      float texels_factor) {
  const Box box{std::max(triangle.left, place_.left), std::min(triangle.right, place_.right),
                std::max(triangle.top, place_.top), std::min(triangle.bottom, place_.bottom)};
  if (hides(box, triangle.nearness_greatest)) return;
  updateFarthest();
  const Edges edges(triangle, box.top, box.bottom);
  std::array<double, kLargest> before, last;  // spans begin after the one and end at or before the other
  edges.spans(box, before.data(), last.data());
  for (int row = edges.top; row <= edges.bottom; ++row) {
    const auto i = static_cast<std::size_t>(row - edges.top);
    if (!(before[i] < last[i])) continue;
    const Span span{row, floorOf(before[i]) + 1, floorOf(last[i])};
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

/// A row of a masked triangle: along it nearness w, and u / depth and v / depth less those of the eye.
struct TileRaster::MaskedRow {
  const TexturePyramid& texture;
  std::uint32_t number;
  float least, greatest;  ///< nearness
  float u_eye, v_eye;
  float w, w_x, w_y, u, u_x, u_y, v, v_x, v_y;  ///< at its first sample, and by column and row
  float texels_factor;

  MaskedRow(const ScreenTriangle& triangle, const Span& span, const MaskPlanes& mask, float factor)
      : texture(*mask.texture),
        number(triangle.number),
        least(triangle.nearness_least),
        greatest(triangle.nearness_greatest),
        u_eye(mask.u_eye),
        v_eye(mask.v_eye),
        texels_factor(factor) {
    const auto set = [&](const Linear& linear, float* at, float* across, float* downwards) {
      *at = static_cast<float>(linear(span.left, span.row));
      *across = static_cast<float>(linear.per_column);
      *downwards = static_cast<float>(linear.per_row);
    };
    set(triangle.nearness, &w, &w_x, &w_y);
    set(mask.u_per_depth, &u, &u_x, &u_y);
    set(mask.v_per_depth, &v, &v_x, &v_y);
  }

  /// How many texels, squared, lie to the next sample right or down: the derivatives of quotients.
  float texelsSquared(float column) const {
    const float depth = 1.0f / std::clamp(w + w_x * column, least, greatest);
    const float u_here = depth * (u + u_x * column), v_here = depth * (v + v_x * column);
    const float factor_x = texture.size().x() * depth, factor_y = texture.size().y() * depth;
    const float right_u = factor_x * (u_x - u_here * w_x), right_v = factor_y * (v_x - v_here * w_x);
    const float down_u = factor_x * (u_y - u_here * w_y), down_v = factor_y * (v_y - v_here * w_y);
    return texels_factor * std::max(right_u * right_u + right_v * right_v, down_u * down_u + down_v * down_v);
  }
};

namespace {

/// Samples of a row that look a mask up together, in one size.
constexpr int kLanes = 8;
using Lanes = std::array<float, kLanes>;

/// The texel of a side of `size` that the coordinate falls into, repeating.
inline int texelOf(float coordinate, int size) {
  const float within = coordinate - static_cast<float>(floorOf(coordinate));
  const int texel = static_cast<int>(within * static_cast<float>(size));
  return texel < size ? texel : size - 1;  // rounding may take it to the end of the row
}

}  // namespace

void TileRaster::fillMasked(const ScreenTriangle& triangle, const Span& span, const MaskPlanes& mask,
                            float texels_factor) {
  const MaskedRow row(triangle, span, mask, texels_factor);
  const std::size_t begin = index(span.left, span.row);
  const int count = span.right - span.left + 1;
  for (int first = 0; first < count; first += kLanes) {
    fillMaskedPart(row, first, std::min(kLanes, count - first), begin + static_cast<std::size_t>(first));
  }
}

/// Samples `first` … of the row's span, which lie at `at`.
void TileRaster::fillMaskedPart(const MaskedRow& row, int first, int count, std::size_t at) {
  float* const nearness = &nearness_[at];
  std::uint32_t* const numbers = &number_[at];
  Lanes here, u, v;
  for (int i = 0; i < kLanes; ++i) {
    const float w = row.w + row.w_x * static_cast<float>(first + i);
    const float raised = w > row.least ? w : row.least;
    here[static_cast<std::size_t>(i)] = raised < row.greatest ? raised : row.greatest;
  }
  unsigned nearer = 0;
  for (int i = 0; i < count; ++i) nearer |= (here[static_cast<std::size_t>(i)] > nearness[i] ? 1u : 0u) << i;
  if (nearer == 0) return;
  for (int i = 0; i < kLanes; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const float column = static_cast<float>(first + i), depth = 1.0f / here[k];
    u[k] = row.u_eye + depth * (row.u + row.u_x * column);
    v[k] = row.v_eye + depth * (row.v + row.v_x * column);
  }
  const float middle = static_cast<float>(first) + 0.5f * static_cast<float>(count - 1);
  const TexturePyramid::Mask mask = row.texture.mask(row.texelsSquared(middle));
  std::array<int, kLanes> x, y;
  for (std::size_t i = 0; i < kLanes; ++i) x[i] = texelOf(u[i], mask.width);
  for (std::size_t i = 0; i < kLanes; ++i) y[i] = texelOf(v[i], mask.height);
  for (int i = 0; i < count; ++i) {
    if ((nearer >> i & 1u) == 0) continue;
    const auto k = static_cast<std::size_t>(i);
    const bool solid =
        mask.full ? row.texture.solid(u[k], v[k]) : mask.alpha[y[k] * mask.width + x[k]] >= mask.least;
    if (!solid) continue;
    nearness[i] = here[k];
    numbers[i] = row.number;
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
