/// Values on a square that repeats itself, and their means.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace sunlit::sky {

/// Of cells, row by row, and of cells twice as wide, and so on.
class CellMeans {
 public:
  static constexpr int kSide = 1024;
  static constexpr float kCell_m = 10.0F;

  /// One value a cell.
  explicit CellMeans(std::vector<float> cells);

  /// Of cells of about `width_m` around a place, m from a corner of the square, in any of its repetitions;
  /// between their middles it is linear.
  float around(const Eigen::Vector2d& place_m, float width_m) const;
  const std::vector<float>& cells() const { return levels_.front(); }

 private:
  static constexpr int kLevels = 8;

  float at(int level, const Eigen::Vector2d& place_m) const;

  std::array<std::vector<float>, kLevels> levels_;
};

}  // namespace sunlit::sky
