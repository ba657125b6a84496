/// Points near other points.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace sunlit::evaluate {

/// Points, by index; none where there is none of that index.
using MaybePoints = std::vector<std::optional<Eigen::Vector2d>>;

/// Points in square cells, so that those within `radius` of a place are found without looking at all.
class NearPoints {
 public:
  /// Keeps a reference to `points`.
  NearPoints(const MaybePoints& points, double radius);

  /// visit(index, squared distance) of each point at most `radius` from `place`, in no particular order.
  template <typename Visit>
  void forEach(const Eigen::Vector2d& place, const Visit& visit) const {
    const Cell middle = cellOf(place);
    for (std::int64_t row = middle.first - 1; row <= middle.first + 1; ++row) {
      for (auto entry = firstFrom({row, middle.second - 1});
           entry != entries_.end() && entry->first <= Cell(row, middle.second + 1); ++entry) {
        const double square = (*points_[entry->second] - place).squaredNorm();
        if (square <= radius_ * radius_) visit(entry->second, square);
      }
    }
  }
  bool hasAny(const Eigen::Vector2d& place) const;

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;  ///< row and column
  using Entry = std::pair<Cell, std::size_t>;
  Cell cellOf(const Eigen::Vector2d& place) const;
  std::vector<Entry>::const_iterator firstFrom(const Cell& cell) const;

  const MaybePoints& points_;
  double radius_;
  std::vector<Entry> entries_;  ///< sorted
};

/// How many of `places` get a partner of their own among `points` within `radius`: the nearest pair first, of
/// equally near ones that of the lowest place, then of the lowest point.
std::size_t countPartners(const MaybePoints& places, const MaybePoints& points, double radius);

}  // namespace sunlit::evaluate
