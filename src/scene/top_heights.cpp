#include "scene/top_heights.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit::scene {
namespace {

/// Cells of the grid along its longer side, at most.
constexpr float kMostCells = 4096.0f;
/// Wider worlds have a margin whose places all count as open.
constexpr float kWidest_m = 4096.0f;

/// Whether rain stops there.
bool shelters(const Material& material) {
  return material.alpha_mode == AlphaMode::kOpaque && !(material.transmission > 0.0f);
}

}  // namespace

TopHeights::TopHeights(const Shape& shape, const std::vector<Material>& materials) {
  const auto forEach = [&](const auto& take) {
    for (std::size_t t = 0; t < shape.triangles.size(); ++t) {
      if (!shelters(materials[static_cast<std::size_t>(shape.materials[t])])) continue;
      const auto& [a, b, c] = shape.triangles[t];
      take(shape.positions[a], shape.positions[b], shape.positions[c]);
    }
  };
  Eigen::Array2f low = Eigen::Array2f::Constant(1e9f), high = -low;
  forEach([&](const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
    for (const Eigen::Vector3f* corner : {&a, &b, &c}) {
      low = low.min(corner->head<2>().array());
      high = high.max(corner->head<2>().array());
    }
  });
  if ((low > high).any()) return;
  const Eigen::Array2f middle = 0.5f * (low + high);
  low = low.max(middle - 0.5f * kWidest_m);
  high = high.min(middle + 0.5f * kWidest_m);
  origin_ = low.matrix();
  cell_m_ = std::max(cell_m_, (high - low).maxCoeff() / kMostCells);
  columns_ = static_cast<int>((high - low).x() / cell_m_) + 1;
  rows_ = static_cast<int>((high - low).y() / cell_m_) + 1;
  height_m_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), kNothing);
  forEach(
      [&](const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) { add(a, b, c); });
}

void TopHeights::add(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
  const Eigen::Vector2f u = (b - a).head<2>(), v = (c - a).head<2>();
  const float area = u.x() * v.y() - u.y() * v.x();
  if (!(std::abs(area) > 1e-9f)) return;
  const auto cellOf = [&](float low, float coordinate, int count) {
    return std::clamp(static_cast<int>(std::floor((coordinate - low) / cell_m_)), 0, count - 1);
  };
  const int left = cellOf(origin_.x(), std::min({a.x(), b.x(), c.x()}), columns_);
  const int right = cellOf(origin_.x(), std::max({a.x(), b.x(), c.x()}), columns_);
  const int low = cellOf(origin_.y(), std::min({a.y(), b.y(), c.y()}), rows_);
  const int high = cellOf(origin_.y(), std::max({a.y(), b.y(), c.y()}), rows_);
  for (int row = low; row <= high; ++row) {
    for (int column = left; column <= right; ++column) {
      const Eigen::Vector2f to = middle(column, row) - a.head<2>();
      const float s = (to.x() * v.y() - to.y() * v.x()) / area, t = (u.x() * to.y() - u.y() * to.x()) / area;
      if (s < 0.0f || t < 0.0f || s + t > 1.0f) continue;
      float& top = height_m_[index(column, row)];
      top = std::max(top, a.z() + s * (b.z() - a.z()) + t * (c.z() - a.z()));
    }
  }
}

TopHeights::Cell TopHeights::cellAt(const Eigen::Vector2f& place) const {
  const Eigen::Vector2f cell = (place - origin_) / cell_m_ - Eigen::Vector2f::Constant(0.5f);
  const int column = static_cast<int>(std::floor(cell.x())), row = static_cast<int>(std::floor(cell.y()));
  return {column, row, cell.x() - static_cast<float>(column), cell.y() - static_cast<float>(row)};
}

std::vector<std::int8_t> TopHeights::relief() const {
  constexpr float kAround_m[] = {1.0f, 2.0f, 4.0f}, kNoLand_m = 0.3f;
  constexpr int kDirections = 8;
  struct Offset {
    int right, up;
  };
  std::vector<Offset> around;
  for (const float radius_m : kAround_m) {
    for (int i = 0; i < kDirections; ++i) {
      const float angle = 2.0f * kPiFloat * static_cast<float>(i) / kDirections;
      around.push_back({static_cast<int>(std::lround(radius_m * std::cos(angle) / cell_m_)),
                        static_cast<int>(std::lround(radius_m * std::sin(angle) / cell_m_))});
    }
  }
  std::vector<std::int8_t> relief(height_m_.size(), 0);
  tbb::parallel_for(0, rows_, [&](int row) {
    for (int column = 0; column < columns_; ++column) {
      const float here = at(column, row);
      if (here == kNothing) continue;
      float above = 0.0f;
      for (const Offset& offset : around) {
        const float step = here - at(column + offset.right, row + offset.up);
        if (std::abs(step) < kNoLand_m) above += step;
      }
      const float mean = above / static_cast<float>(around.size());
      relief[index(column, row)] =
          static_cast<std::int8_t>(std::lround(127.0f * std::clamp(mean / kReliefReach_m, -1.0f, 1.0f)));
    }
  });
  return relief;
}

}  // namespace sunlit::scene
