#include "evaluate/verify/near_points.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace sunlit::evaluate {

NearPoints::NearPoints(const MaybePoints& points, double radius) : points_(points), radius_(radius) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i]) entries_.emplace_back(cellOf(*points[i]), i);
  }
  std::sort(entries_.begin(), entries_.end());
}

NearPoints::Cell NearPoints::cellOf(const Eigen::Vector2d& place) const {
  return {static_cast<std::int64_t>(std::floor(place.y() / radius_)),
          static_cast<std::int64_t>(std::floor(place.x() / radius_))};
}

std::vector<NearPoints::Entry>::const_iterator NearPoints::firstFrom(const Cell& cell) const {
  return std::lower_bound(entries_.begin(), entries_.end(), Entry(cell, 0));
}

bool NearPoints::hasAny(const Eigen::Vector2d& place) const {
  bool is_any = false;
  forEach(place, [&](std::size_t, double) { is_any = true; });
  return is_any;
}

std::size_t countPartners(const MaybePoints& places, const MaybePoints& points, double radius) {
  using Candidate = std::tuple<double, std::size_t, std::size_t>;
  std::vector<Candidate> candidates;
  const NearPoints near(points, radius);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) continue;
    near.forEach(*places[i], [&](std::size_t j, double square) { candidates.emplace_back(square, i, j); });
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<char> has_partner(places.size(), 0);
  std::vector<char> is_partner(points.size(), 0);
  std::size_t count = 0;
  for (const auto& [square, place, point] : candidates) {
    if (has_partner[place] != 0 || is_partner[point] != 0) continue;
    has_partner[place] = is_partner[point] = 1;
    ++count;
  }
  return count;
}

}  // namespace sunlit::evaluate
