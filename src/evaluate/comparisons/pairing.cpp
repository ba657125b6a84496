#include "evaluate/comparisons/pairing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "sunlit/evaluate/comparisons/comparisons.h"
#include "sunlit/evaluate/localise/localiser.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::evaluate {
namespace {

using Places = std::vector<MeasuredPlace>;

Paired byNumber(const Measured& first, const Measured& second) {
  Paired paired;
  auto a = first.values.begin();
  auto b = second.values.begin();
  while (a != first.values.end() && b != second.values.end()) {
    if (a->first == b->first) {
      paired.a.push_back(a++->second);
      paired.b.push_back(b++->second);
    } else {
      a->first < b->first ? ++a : ++b;
    }
  }
  return paired;
}

/// Places by the cube that they lie in. Drives of an hour have 100,000 of them: nobody asks all for all.
class Cubes {
 public:
  explicit Cubes(const Places& places) {
    for (std::size_t i = 0; i < places.size(); ++i) numbers_[cubeOf(places[i].position)].push_back(i);
  }
  /// All that lie as near as kSharedPlace_m, and others.
  template <typename Take>
  void forEachAround(const Eigen::Vector3d& position, const Take& take) const {
    const Cube middle = cubeOf(position);
    for (int number = 0; number < 27; ++number) {
      const Cube cube = {middle[0] + number % 3 - 1, middle[1] + number / 3 % 3 - 1,
                         middle[2] + number / 9 - 1};
      const auto found = numbers_.find(cube);
      if (found != numbers_.end()) std::for_each(found->second.begin(), found->second.end(), take);
    }
  }

 private:
  using Cube = std::array<double, 3>;  // whole numbers of any size
  static Cube cubeOf(const Eigen::Vector3d& position) {
    constexpr double kEdge_m = 1.01 * kSharedPlace_m;  // rounding does not matter
    return {std::floor(position.x() / kEdge_m), std::floor(position.y() / kEdge_m),
            std::floor(position.z() / kEdge_m)};
  }
  std::map<Cube, std::vector<std::size_t>> numbers_;
};

/// Of each of `from` the place among `to`.
std::vector<std::optional<std::size_t>> nearestOf(const Places& from, const Places& to) {
  const double same_way = std::cos(kSameWay_deg * kRadPerDeg);
  const Cubes cubes(to);
  std::vector<std::optional<std::size_t>> nearest(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    double least = kSharedPlace_m * kSharedPlace_m * (1.0 + kLengthRounding);
    cubes.forEachAround(from[i].position, [&](std::size_t j) {
      const double squared = (from[i].position - to[j].position).squaredNorm();
      const bool is_nearer = squared < least || (squared == least && nearest[i] && j < *nearest[i]);
      if (!is_nearer || from[i].direction.dot(to[j].direction) <= same_way) return;
      least = squared;
      nearest[i] = j;
    });
  }
  return nearest;
}

Paired byPlace(const Measured& first, const Measured& second) {
  const auto there = nearestOf(first.places, second.places);
  const auto back = nearestOf(second.places, first.places);
  Paired paired;
  for (std::size_t i = 0; i < there.size(); ++i) {
    if (!there[i] || back[*there[i]] != i) continue;
    paired.a.push_back(first.values[i].second);
    paired.b.push_back(second.values[*there[i]].second);
  }
  return paired;
}

}  // namespace

Paired pairedOf(const Measured& first, const Measured& second) {
  Paired paired = first.drive == second.drive ? byNumber(first, second) : byPlace(first, second);
  paired.unpaired = first.values.size() + second.values.size() - 2 * paired.a.size();
  return paired;
}

}  // namespace sunlit::evaluate
