#include "render/gl/mask_sizes.h"

#include <algorithm>
#include <cmath>

namespace sunlit::render::gl {
namespace {

struct Range {
  double least, greatest;
};

/// Of (a + b t)² + (c + d t)² for t from 0 to `end`.
Range squaredLength(const Eigen::Vector2d& start, const Eigen::Vector2d& step, double end) {
  const double first = start.squaredNorm(), last = (start + end * step).squaredNorm();
  const double steepness = step.squaredNorm();
  const double nearest = steepness > 0.0 ? std::clamp(-start.dot(step) / steepness, 0.0, end) : 0.0;
  return {(start + nearest * step).squaredNorm(), std::max(first, last)};
}

/// Of 1 / depth over the box of a triangle.
Range nearnessIn(const ScreenTriangle& t) {
  Range range{HUGE_VAL, -HUGE_VAL};
  for (const int column : {t.left, t.right}) {
    for (const int row : {t.top, t.bottom}) {
      const double here = t.nearness(column, row);
      range = {std::min(range.least, here), std::max(range.greatest, here)};
    }
  }
  const double least = t.nearness_least, greatest = t.nearness_greatest;
  return {std::clamp(range.least, least, greatest), std::clamp(range.greatest, least, greatest)};
}

int sizeOf(double texels_squared) {
  return texels_squared >= 4.0 ? static_cast<int>(std::min(0.5 * std::log2(texels_squared), 31.0)) : 0;
}

}  // namespace

MaskSizes maskSizesOf(const ScreenTriangle& t, const MaskPlanes& planes, float texels_factor) {
  const Linear &w = t.nearness, &u = planes.u_per_depth, &v = planes.v_per_depth;
  const Eigen::Array2d size = planes.texture->size().cast<double>();
  const auto texels = [&size](double along_u, double along_v) {
    return Eigen::Vector2d(size.x() * along_u, size.y() * along_v);
  };
  // A coordinate is u / w of two functions that are linear on the screen. Its derivative to the right is
  // (u_x w - u w_x) / w², whose numerator is constant along a row, and changes downwards as much as that of
  // its derivative downwards changes to the left.
  const double column = t.left, row = t.top;
  const double w_0 = w(column, row), u_0 = u(column, row), v_0 = v(column, row);
  const Eigen::Vector2d right =
      texels(u.per_column * w_0 - u_0 * w.per_column, v.per_column * w_0 - v_0 * w.per_column);
  const Eigen::Vector2d down = texels(u.per_row * w_0 - u_0 * w.per_row, v.per_row * w_0 - v_0 * w.per_row);
  const Eigen::Vector2d change = texels(u.per_column * w.per_row - u.per_row * w.per_column,
                                        v.per_column * w.per_row - v.per_row * w.per_column);
  const Range to_the_right = squaredLength(right, change, t.bottom - t.top);
  const Range downwards = squaredLength(down, -change, t.right - t.left);
  const Range nearness = nearnessIn(t);
  const double factor = static_cast<double>(texels_factor);
  return {sizeOf(factor * std::max(to_the_right.least, downwards.least) / std::pow(nearness.greatest, 4)),
          sizeOf(factor * std::max(to_the_right.greatest, downwards.greatest) / std::pow(nearness.least, 4))};
}

}  // namespace sunlit::render::gl
