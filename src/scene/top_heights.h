/// The world as rain meets it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sunlit/scene/scene.h"
#include "sunlit/scene/shape.h"

namespace sunlit::scene {

/// The height of the topmost surface over each cell of a grid, past what is cut out or blends. Immutable.
class TopHeights {
 public:
  static constexpr float kNothing = -1e9f;
  /// What lies no deeper below the topmost surface is of it: cells are coarse, and land uneven.
  static constexpr float kSlack_m = 0.15f;

  /// The same bits for any number of threads.
  TopHeights(const Shape& shape, const std::vector<Material>& materials);

  bool empty() const { return columns_ == 0; }
  float cell_m() const { return cell_m_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  /// m in `map`; kNothing where there is nothing, and beyond the grid.
  float at(int column, int row) const {
    return column < 0 || row < 0 || column >= columns_ || row >= rows_ ? kNothing
                                                                       : height_m_[index(column, row)];
  }
  /// Of a cell's middle, in `map`.
  Eigen::Vector2f middle(int column, int row) const {
    return origin_ +
           cell_m_ * Eigen::Vector2f(static_cast<float>(column) + 0.5f, static_cast<float>(row) + 0.5f);
  }
  /// The cell whose middle is left and below of a place, and how far beyond it lies, in cells.
  struct Cell {
    int column, row;
    float right, up;
  };
  Cell cellAt(const Eigen::Vector2f& place) const;

  /// Of every cell, row by row: how far it lies above the land around it within 4 m, −127 … 127 for
  /// −kReliefReach_m … kReliefReach_m. Walls, posts and edges of roofs, from 0.3 m up, are no land.
  static constexpr float kReliefReach_m = 0.05f;
  std::vector<std::int8_t> relief() const;
  /// Of a cell of the grid, row by row.
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

 private:
  void add(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c);

  Eigen::Vector2f origin_ = Eigen::Vector2f::Zero();  ///< m, the outer corner of cell (0, 0)
  float cell_m_ = 0.25f;
  int columns_ = 0, rows_ = 0;
  std::vector<float> height_m_;
};

}  // namespace sunlit::scene
